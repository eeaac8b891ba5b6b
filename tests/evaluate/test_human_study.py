from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import genc.evaluate.human_study as study
from genc.errors import StudyError
from genc.evaluate.distances import js_divergence
from genc.evaluate.human_study import (
    SYNTHETIC_RESPONSES,
    Prompt,
    Response,
    expected_actions,
    human_floor,
    performed_actions,
    read_prompts,
    read_responses,
)
from genc.graph.crowd_graph import CrowdGraph
from genc.scenario.corpus import load_corpus, themes
from genc.words.vocabulary import ACTIONS, Action

DOCS = Path(__file__).parents[2] / "docs/study.md"
PROMPTS = [Prompt("hall", "station", "general", "?"), Prompt("desk", "station", "specific", "?")]
HEADER = "participant,prompt,rank1,rank2,rank3,rank4,rank5"
FIVE = (Action.SIT, Action.READ, Action.WAIT, Action.QUEUE, Action.CARRY)


@pytest.fixture
def write(tmp_path: Path):
    def written(text: str | bytes) -> Path:
        path = tmp_path / "answers.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return written


def answer(participant: str, prompt: str, *ranking: Action) -> Response:
    return Response(participant, prompt, ranking)


def test_the_shipped_prompts_are_as_many_of_each_kind_as_in_the_paper():
    prompts = read_prompts()
    of = Counter((p.theme, p.kind) for p in prompts)
    assert len({p.theme for p in prompts}) == 2
    assert all(of[theme, "specific"] == 7 and of[theme, "general"] == 2 for theme in {p.theme for p in prompts})
    assert {p.theme for p in prompts} <= set(themes())
    assert len({p.id for p in prompts}) == len({p.text for p in prompts}) == 18


def test_the_shipped_prompts_are_no_sentence_of_the_corpus():
    learned = {text for s in load_corpus() for text in (s.sentence, *s.paraphrases, *(g.caption for g in s.groups))}
    assert not {text.casefold() for text in learned} & {p.text.casefold() for p in read_prompts()}


def test_the_shipped_answers_say_that_they_are_invented_and_answer_every_prompt():
    prompts = read_prompts()
    responses = read_responses(SYNTHETIC_RESPONSES, prompts)
    people = {r.participant for r in responses}
    assert "synthetic" in SYNTHETIC_RESPONSES.name
    assert SYNTHETIC_RESPONSES.read_text().startswith("# SYNTHETIC")
    assert len(people) >= 12
    assert {(r.participant, r.prompt) for r in responses} == {(who, p.id) for who in people for p in prompts}
    assert 0 < human_floor(responses, 20, np.random.default_rng(0)) < 0.05


def test_the_examples_of_the_page_can_be_read(write):
    prompts, answers = re.findall(r"```csv\n(.*?)```", DOCS.read_text(), re.S)
    read = read_prompts(write(prompts))
    assert read == [p for p in read_prompts() if p.id in {"station-tickets", "station-hall"}]
    assert len(read_responses(write(answers), read)) == 3


def test_comments_blank_lines_quotes_case_and_the_marks_of_other_systems_are_no_trouble(write):
    first = ' p1 , hall ,Sit,"read", wait,queue ,CARRY'
    second = '"Ann, the 2nd",hall,sit,read,wait,queue,carry'
    text = f"# said so\n\n{HEADER}\n# more\n{first}\n\n{second}"
    for encoded in (text, "\ufeff" + text, text.replace("\n", "\r\n")):
        assert read_responses(write(encoded), PROMPTS) == [
            answer("p1", "hall", *FIVE),
            answer("Ann, the 2nd", "hall", *FIVE),
        ]


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ("p1,hall,sit,read,wait,queue", "6 cells; write 7: participant,prompt,rank1"),
        ("p1,hall,sit,read,wait,queue,carry,meet", "8 cells; write 7"),
        ("p1;hall;sit;read;wait;queue;carry", "1 cells; write 7"),
        (",hall,sit,read,wait,queue,carry", "participant is empty; give"),
        ("p1,hal,sit,read,wait,queue,carry", "unknown prompt 'hal'; did you mean 'hall'?"),
        ("p1,zzzz,sit,read,wait,queue,carry", "unknown prompt 'zzzz'; known are: desk, hall"),
        ("p1,hall,sit,read,wait,queu,carry", "rank4 is no action: 'queu'; did you mean 'queue'?"),
        ("p1,hall,sit,read,,queue,carry", "rank3 is empty; an answer ranks 5 actions"),
        ("p1,hall,sit,read,Sit,queue,carry", "'sit' is ranked 2 times; name 5 different actions"),
        ('p1,hall,"sit,read,wait,queue,carry', "no CSV (unexpected end of data)"),
        ("p0,desk,sit,read,wait,queue,carry", "a second answer of 'p0' to 'desk', first at {path}:2; keep one"),
    ],
)
def test_each_fault_is_one_line_that_says_where_what_and_what_to_do(write, row, problem):
    path = write(f"{HEADER}\np0,desk,sit,read,wait,queue,carry\n# a comment counts as a line\n{row}\n")
    with pytest.raises(StudyError) as caught:
        read_responses(path, PROMPTS)
    (said,) = caught.value.problems
    assert said.startswith(f"{path}:4: {problem.format(path=path)}")
    assert "\n" not in said


def test_all_faults_are_said_at_once(write):
    with pytest.raises(StudyError) as caught:
        read_responses(write(f"{HEADER}\n,hal,sit,,wait,queue,carry\np1,hall,sit\n"), PROMPTS)
    assert len(caught.value.problems) == 4
    assert str(caught.value) == "\n".join(caught.value.problems)


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (
            "p1,hall,sit,read,wait,queue,carry\n",
            f":1: the header is 'p1,hall,sit,read,wait,queue,carry'; write '{HEADER}'",
        ),
        (HEADER.replace(",", ";"), ":1: the header is 'participant;prompt"),
        (f"{HEADER}\n# nobody came\n", ": no rows; write"),
        ("", ": no rows; write"),
        (b"participant\xff", ": not UTF-8 text (byte 11); save it as UTF-8"),
    ],
)
def test_a_file_that_is_no_table_of_answers(write, content, problem):
    path = write(content)
    with pytest.raises(StudyError) as caught:
        read_responses(path, PROMPTS)
    assert str(caught.value).startswith(f"{path}{problem}")


def test_a_file_that_cannot_be_read(tmp_path):
    for path, reason in ((tmp_path / "none.csv", "No such file"), (tmp_path, "Is a directory")):
        with pytest.raises(StudyError, match=rf"{re.escape(str(path))}: cannot be read \({reason}.*; check the name"):
            read_prompts(path)


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ("a,t,general", "3 cells; write 4: id,theme,kind,text"),
        (",t,general,What?", "id is empty; fill it"),
        ("a,,general,What?", "theme is empty; fill it"),
        ("a,t,,What?", "kind is empty; fill it"),
        ("a,t,general,", "text is empty; fill it"),
        ("a,t,genral,What?", "unknown kind 'genral'; did you mean 'general'?"),
        ("q,t,general,What?", "a second prompt 'q', first at {path}:2; give it its own id"),
    ],
)
def test_each_fault_of_a_prompt(write, row, problem):
    path = write(f"id,theme,kind,text\nq,t,specific,Who?\n{row}\n")
    with pytest.raises(StudyError) as caught:
        read_prompts(path)
    assert caught.value.problems == (f"{path}:3: {problem.format(path=path)}",)


def test_ranks_become_probabilities_by_borda_s_weights():
    expected = dict(zip(ACTIONS, expected_actions([answer("p1", "hall", *FIVE)]).tolist(), strict=True))
    assert [expected.pop(action) for action in FIVE] == pytest.approx([5 / 15, 4 / 15, 3 / 15, 2 / 15, 1 / 15])
    assert set(expected.values()) == {0}


def test_other_weights_ask_other_questions():
    one, two = answer("p1", "hall", *FIVE), answer("p2", "hall", *FIVE[::-1])
    named = expected_actions([one, two], (1, 1, 1, 1, 1))
    assert sorted(named)[-5:] == pytest.approx([0.2] * 5)
    first = expected_actions([one, two, one], (1, 0, 0, 0, 0))
    assert [first[ACTIONS.index(a)] for a in (Action.SIT, Action.CARRY)] == pytest.approx([2 / 3, 1 / 3])
    assert expected_actions([one, two], (10, 8, 6, 4, 2)) == pytest.approx(expected_actions([one, two]))


def test_each_prompt_counts_the_same_however_many_answered_it():
    of_hall = [answer(f"p{i}", "hall", *FIVE) for i in range(9)]
    others = (Action.MEET, Action.DISCUSS, Action.WANDER, Action.LOOK_AT, Action.WAVE_AT)
    expected = expected_actions([*of_hall, answer("p1", "desk", *others)])
    assert expected[[ACTIONS.index(a) for a in FIVE]].sum() == pytest.approx(0.5)
    assert expected.sum() == pytest.approx(1)


def test_what_groups_do_is_counted_over_all_their_nodes():
    one = CrowdGraph(np.zeros(3), np.zeros(3), np.array([0, 0, 4]), np.zeros(3))
    other = CrowdGraph(np.zeros(1), np.zeros(1), np.array([11]), np.zeros(1))
    done = performed_actions([one, other])
    assert done.shape == (13,)
    assert {i: done[i] for i in np.flatnonzero(done)} == {0: 0.5, 4: 0.25, 11: 0.25}


def test_the_floor_is_how_far_people_are_from_each_other():
    others = (Action.MEET, Action.DISCUSS, Action.WANDER, Action.LOOK_AT, Action.WAVE_AT)
    agreed = [answer(f"p{i}", "hall", *FIVE) for i in range(6)]
    assert human_floor(agreed, 5, np.random.default_rng(0)) == pytest.approx(0, abs=1e-12)
    opposed = [answer("p1", p, *FIVE) for p in ("hall", "desk")] + [answer("p2", p, *others) for p in ("hall", "desk")]
    assert human_floor(opposed, 5, np.random.default_rng(0)) == pytest.approx(1)
    one_of_four = [*agreed[:2], answer("p3", "hall", *FIVE), answer("p4", "hall", *others)]
    wanted = js_divergence(expected_actions(one_of_four[:2]), expected_actions(one_of_four[2:]))
    assert human_floor(one_of_four, 5, np.random.default_rng(0)) == pytest.approx(wanted)  # two against two, always
    mixed = read_responses(SYNTHETIC_RESPONSES, read_prompts())
    assert human_floor(mixed, 3, np.random.default_rng(1)) == human_floor(mixed, 3, np.random.default_rng(1))
    assert human_floor(mixed, 9, np.random.default_rng(1), (1, 0, 0, 0, 0)) > human_floor(
        mixed, 9, np.random.default_rng(1)
    )


def test_the_floor_is_a_mean_over_halves_that_are_drawn_anew():
    rng = np.random.default_rng(0)
    mixed = read_responses(SYNTHETIC_RESPONSES, read_prompts())
    single = [human_floor(mixed, 1, rng) for _ in range(8)]
    assert len(set(single)) > 4
    assert human_floor(mixed, 8, np.random.default_rng(0)) == pytest.approx(np.mean(single))


def test_nobody_expects_nothing():
    with pytest.raises(ValueError, match="no answers"):
        expected_actions([])
    with pytest.raises(ValueError, match="1 people"):
        human_floor([answer("p1", "hall", *FIVE)], 5, np.random.default_rng(0))


def test_the_files_lie_in_the_package():
    assert study.PROMPTS.parent == SYNTHETIC_RESPONSES.parent == Path(study.__file__).parent / "study"
