"""What replies may look like, and what is found in those that may not."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.errors import ScriptError
from genc.scenario.author.dialogue import ask_until_sound
from genc.scenario.author.events import Wish, read_events
from genc.scenario.author.examples import draw, events_example, layout_example
from genc.scenario.author.layout import layout_faults, read_layout
from genc.scenario.author.replies import Happenings, Layout, Sentences, schema_of
from genc.scenario.author.seeds import Seed, parse_seeds, write_seeds
from genc.scenario.corpus import load_corpus
from genc.scenario.exchange import write_json
from genc.words.language import Question, Reply, Turn, Usage
from genc.words.vocabulary import ACTIONS, CATEGORIES

CORPUS = load_corpus()
SCENE = CORPUS[0]
DOCUMENT = json.loads(write_json([SCENE]))["scenarios"][0]
NAMES = [location.name for location in SCENE.environment.locations]


def objects(schema):
    if isinstance(schema, dict):
        if schema.get("type") == "object":
            yield schema
        for part in schema.values():
            yield from objects(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from objects(part)


@pytest.mark.parametrize("reply", [Sentences, Layout, Happenings])
def test_schemas_are_as_strict_as_servers_want_them(reply):
    found = list(objects(schema_of(reply)))
    assert found
    for part in found:
        assert part["additionalProperties"] is False
        assert part["required"] == list(part["properties"])
        assert not any("default" in entry for entry in part["properties"].values())


def test_schemas_know_the_vocabulary_and_the_places():
    schema = schema_of(Happenings, NAMES)
    assert schema["$defs"]["Action"]["enum"] == list(ACTIONS)
    assert schema["$defs"]["Pair"]["properties"]["location"]["enum"] == NAMES
    assert schema_of(Layout)["$defs"]["Category"]["enum"] == list(CATEGORIES)
    assert "enum" not in schema_of(Happenings)["$defs"]["Pair"]["properties"]["location"]


def test_every_authored_scenario_is_a_good_reply():
    booked_twice = []
    for scenario, document in zip(CORPUS, json.loads(write_json(CORPUS))["scenarios"], strict=True):
        Layout.model_validate({"locations": document["locations"]})
        Happenings.model_validate({"groups": document["groups"]})
        assert read_layout(json.dumps({"locations": document["locations"]})) == scenario.environment
        try:
            assert read_events(json.dumps({"groups": document["groups"]}), scenario, Wish.of_groups(16)) == scenario
        except ScriptError as error:
            booked_twice += error.problems
    assert len(booked_twice) <= 4
    assert all("begin together and both need agent" in line for line in booked_twice)


def spoilt(**more):
    return json.dumps({"groups": [{"caption": "people wait", "events": [{**EVENT, **more}]}]})


EVENT = {"id": 1, "after": None, "agents": ["a"], "pairs": [{"action": "wait", "location": NAMES[0]}]}


def many(letters, n=1, **more):
    events = [{**EVENT, "id": i + 1, "after": i or None, "agents": list(letters), **more} for i in range(n)]
    return json.dumps({"groups": [{"caption": "people wait", "events": events}]})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Here you are: {", "not JSON"),
        ("[1, 2]", "no scenario in it"),
        ("{}", "no group"),
        ('{"groups": 3}', "write a list"),
        (spoilt(pairs=[{"action": "fly", "location": NAMES[0]}]), "unknown action 'fly'"),
        (spoilt(pairs=[{"action": "wait", "location": "moon"}]), "unknown location 'moon'"),
        (spoilt(agents=["b"]), "letters run without a gap"),
        (spoilt(agents=["a", "a"]), "names agent 'a' twice"),
        (spoilt(after=1), "in a circle"),
        (spoilt(after=7), "does not exist"),
        (many("abcdefghijklmnop"), "16 people in a group"),
        (many("a", 31), "31 events in a group"),
        (many("abcdefghijk", 10), "110 nodes"),
        (many("a", 2, after=None), "begin together and both need agent 'a'; let one wait for the other: \"after\": 1"),
        (spoilt(), "only 1 groups; write about 16 groups"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_what_is_wrong_with_events_is_told(text, said):
    with pytest.raises(ScriptError) as caught:
        read_events(text, SCENE, Wish.of_groups(16))
    assert any(line.startswith("reply") and said in line for line in caught.value.problems), caught.value.problems


def plan(*places):
    base = [*DOCUMENT["locations"][:7], *places]
    return json.dumps({"locations": base})


def place(name, category="item", position=(500, 0), scale=(1, 1)):
    return {"name": name, "category": category, "position": list(position), "scale": list(scale)}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"locations": []}', "0 locations; write 6 to 30"),
        (json.dumps({"locations": [place(str(n), position=(3 * n, 0)) for n in range(8)]}), "no entrance"),
        (plan(place("x", "portal")), "unknown category 'portal'"),
        (plan(place("x", position=(5000, 0))), "m across; make it 10 to 400 m"),
        (plan(place("x", position=(90, 90)), place("y", position=(90.5, 90))), "'y' overlaps 'x'; both are solid"),
        (plan(place("x", scale=(0, 1))), "is not positive"),
        (plan(place("x"), place("x")), "a second location named 'x'"),
        (plan(place("one, two")), "bad location name"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_what_is_wrong_with_a_layout_is_told(text, said):
    with pytest.raises(ScriptError) as caught:
        read_layout(text)
    assert any(line.startswith("reply") and said in line for line in caught.value.problems), caught.value.problems


def test_areas_may_hold_things_and_each_other():
    assert not list(layout_faults(SCENE.environment))


def test_examples_are_drawn_by_seed_and_subject():
    assert draw(CORPUS, 2, 0, "one") == draw(CORPUS, 2, 0, "one")
    assert len({tuple(s.slug for s in draw(CORPUS, 2, seed, subject)) for seed in (0, 1) for subject in "abc"}) == 6
    assert draw(CORPUS[:1], 5, 0, "one") == [CORPUS[0]]


def test_examples_are_replies_that_would_be_taken():
    for scenario in CORPUS[::20]:
        read_layout(layout_example(scenario).splitlines()[-1])
        shown = events_example(scenario).splitlines()[-1]
        few = read_events(shown, scenario, Wish("a few"))
        assert 1 <= len(few.groups) <= 5


class Answers:
    """Replies in a row."""

    id = "answers"

    def __init__(self, *replies: Reply) -> None:
        self.replies, self.asked = list(replies), []

    def ask(self, question: Question) -> Reply:
        self.asked.append(question)
        return self.replies.pop(0)


def reply(text, ending="stop"):
    return Reply(text, Usage(), ending)


QUESTION = Question((Turn("system", "rules"), Turn("user", "write")), {"title": "Sentences"}, subject="s", step="t")


def sound(text):
    if text != "good":
        raise ScriptError([f"reply: {text!r} is not good; write 'good'"])
    return text


def test_a_model_is_told_what_to_mend():
    model = Answers(reply("bad"), reply("worse"), reply("```json\ngood\n```"))
    assert ask_until_sound(model, QUESTION, sound) == "good"
    first, second, third = model.asked
    assert first == QUESTION
    assert second.turns[:3] == (*QUESTION.turns, Turn("assistant", "bad"))
    assert "- reply: 'bad' is not good; write 'good'" in second.turns[3].text
    assert [turn.text for turn in third.turns[2:3]] == ["worse"]
    assert (third.attempt, third.subject, third.step) == (2, "s", "t")


@pytest.mark.parametrize("useless", [reply(""), reply("no", "refusal"), reply("x", "content_filter")])
def test_without_a_reply_to_mend_the_question_is_asked_anew(useless):
    model = Answers(useless, reply("good"))
    assert ask_until_sound(model, QUESTION, sound) == "good"
    (rules, asked), again = QUESTION.turns, model.asked[1]
    assert again.turns[0] == rules
    assert again.turns[1].text.startswith(f"{asked.text}\n\nThat reply cannot be used")
    assert (len(again.turns), again.attempt) == (2, 1)


def test_asking_ends_with_the_last_words():
    model = Answers(*[reply(f"bad {n}") for n in range(4)])
    with pytest.raises(ScriptError, match="'bad 3' is not good"):
        ask_until_sound(model, QUESTION, sound)
    assert len(model.asked) == 4


def test_a_reply_that_was_cut_off_is_no_reply_even_if_it_can_be_read():
    model = Answers(reply("good", "length"), reply("good"))
    ask_until_sound(model, QUESTION, sound)
    assert "cut off" in model.asked[1].turns[-1].text


words = st.text(st.characters(categories=["L", "N"]), min_size=1, max_size=8)
lines = st.lists(words, min_size=1, max_size=6).map(" ".join).filter(lambda line: not line.startswith("T:"))


@given(
    st.lists(
        st.builds(Seed, lines, lines, st.lists(lines, max_size=3).map(tuple)),
        min_size=1,
        max_size=6,
        unique_by=lambda s: s.sentence,
    )
)
def test_seeds_there_and_back(seeds):
    assert parse_seeds(write_seeds(seeds), "x") == tuple(seeds)


def test_everything_wrong_with_seeds_is_told():
    with pytest.raises(ScriptError) as caught:
        parse_seeds("one\nT: t\n  indented\ntwo\n  other\n\ntwo\n", "s.txt")
    assert [line.partition(";")[0] for line in caught.value.problems] == [
        "s.txt:1: a seed before any theme",
        "s.txt:3: a wording without a sentence above it",
        "s.txt:7: the same sentence as in line 4",
    ]
    for empty in ("", "# only this", "T: theme\n"):
        with pytest.raises(ScriptError, match="no seed in it"):
            parse_seeds(empty, "s.txt")
