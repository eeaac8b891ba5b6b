from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any

import pytest
from drawn_scenarios import scenarios
from hypothesis import given
from hypothesis import strategies as st

from genc.errors import LayoutError, ScriptError
from genc.scenario.exchange import parse_json, read_drafts, read_environment, write_json
from genc.scenario.faults import faults
from genc.scenario.scenario import Scenario
from genc.scenario.script import parse_script, script_drafts

SCRIPT = """\
=== kiosk
S: At the kiosk a woman buys a paper.
L: hall | room | 10,5 | 20x10
L: kiosk | service area | 4,2.5 | 3x2
G: a woman buys a paper
1 - a: queue@kiosk, object interact@kiosk
2 >1 a: wait@hall
"""


def document() -> dict[str, Any]:
    data: dict[str, Any] = json.loads(write_json(parse_script(SCRIPT, "s")))
    return data


def problems_of(data: Any) -> tuple[str, ...]:
    with pytest.raises(ScriptError) as caught:
        parse_json(data if isinstance(data, str) else json.dumps(data), "s.json")
    return caught.value.problems


def test_the_json_has_the_shape_of_the_papers_two_queries() -> None:
    (scenario,) = document()["scenarios"]
    assert scenario["locations"][1] == {
        "name": "kiosk",
        "category": "service area",
        "position": [4.0, 2.5],
        "scale": [3.0, 2.0],
    }
    assert scenario["groups"][0]["events"][1] == {
        "id": 2,
        "after": 1,
        "agents": ["a"],
        "pairs": [{"action": "wait", "location": "hall"}],
    }


@given(st.lists(scenarios(), min_size=1, max_size=2, unique_by=lambda s: s.slug))
def test_written_scenarios_are_read_back_equal(drawn: list[Scenario]) -> None:
    assert parse_json(write_json(drawn), "s.json") == tuple(drawn)


def test_every_shipped_scenario_is_read_back_equal(authored: tuple[Scenario, ...]) -> None:
    assert parse_json(write_json(authored), "corpus") == authored


def test_a_bare_scenario_is_a_list_of_one() -> None:
    assert parse_json(json.dumps(document()["scenarios"][0]), "s") == parse_script(SCRIPT, "s")


@pytest.mark.parametrize(
    ("where", "value", "expected"),
    [
        ("sentence", 5, "scenarios[0].sentence: found 5; write a text"),
        ("sentence", "", "scenarios[0].sentence: no sentence (S:); say in one line"),
        ("groups", {}, "scenarios[0].groups: found {}; write a list"),
        ("groups", [], "scenarios[0].groups: no group (G:)"),
        ("locations.0", 3, "scenarios[0].locations[0]: found 3; write an object {...}"),
        ("locations.0.category", "rom", "scenarios[0].locations[0].category: unknown category 'rom'; did you"),
        ("locations.0.category", None, "scenarios[0].locations[0].category: missing; write a text"),
        ("locations.0.position", [1, None], "scenarios[0].locations[0].position: found [1, null]; write two"),
        ("locations.0.position", [1, float("nan")], "scenarios[0].locations[0].position: found [1, NaN]"),
        ("locations.0.scale", [True, 2], "scenarios[0].locations[0].scale: found [true, 2]"),
        ("locations.0.scale", [0, 2], "scenarios[0].locations[0]: size 0 x 2 m is not positive"),
        ("locations.0.name", "hall, left", "scenarios[0].locations[0]: bad location name 'hall, left'"),
        ("groups.0.events.0.id", "1", 'scenarios[0].groups[0].events[0].id: found "1"; write a whole number'),
        ("groups.0.events.0.id", -1, "scenarios[0].groups[0].events[0]: bad event number -1"),
        ("groups.0.events.0.id", 2, "scenarios[0].groups[0].events[1]: event number 2 is used twice"),
        ("groups.0.events.0.after", 2, "scenarios[0].groups[0].events[0]: events wait for each other"),
        ("groups.0.events.0.after", True, "scenarios[0].groups[0].events[0].after: found true"),
        ("groups.0.events.0.agents", "ab", 'scenarios[0].groups[0].events[0].agents: found "ab"; write a list'),
        ("groups.0.events.0.agents", ["a", "Bo"], "scenarios[0].groups[0]: the agents are called Bo, a"),
        ("groups.0.events.0.agents", [], "scenarios[0].groups[0].events[0]: event 1 has no agents"),
        ("groups.0.events.0.pairs", [], "scenarios[0].groups[0].events[0]: event 1 does nothing"),
        ("groups.0.events.0.pairs.1", 0, "scenarios[0].groups[0].events[0].pairs[1]: found 0; write an object"),
        ("groups.0.events.0.pairs.1.action", "Queue", "pairs[1].action: unknown action 'Queue'; did you mean"),
        ("groups.0.events.0.pairs.1.location", "moon", "pairs[1]: event 1: unknown location 'moon'; known"),
    ],
)
def test_each_fault_is_told_with_its_path_and_its_remedy(where: str, value: Any, expected: str) -> None:
    data = document()
    *path, last = [int(step) if step.isdecimal() else step for step in where.split(".")]
    inner: Any = data["scenarios"][0]
    for step in path:
        inner = inner[step]
    inner[last] = value
    if where == "groups.0.events.0.id" and value == -1:
        data["scenarios"][0]["groups"][0]["events"][1]["after"] = None
    found = problems_of(data)
    consequences = [p for p in found if "unknown location 'hall'" in p or "waits for event 1" in p]
    assert len(found) - len(consequences) == 1, found
    assert expected in next(p for p in found if p not in consequences)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"scenarios": [', "s.json:1: not JSON ("),
        ("[1, 2]", "s.json: no scenario in it"),
        ('{"scenarios": []}', "s.json: no scenario in it"),
        ("[" * 100_000, "s.json: JSON out of all measure"),
        ('{"id": ' + "1" * 5000 + "}", "s.json: JSON out of all measure"),
    ],
)
def test_a_text_without_scenarios_is_refused(text: str, expected: str) -> None:
    assert problems_of(text)[0].startswith(expected)


def test_script_and_json_share_one_checker() -> None:
    text = SCRIPT.replace("2 >1 a", "2 >7 ac").replace("queue@kiosk", "queue@kisok")
    scenario = script_drafts(text, "s")[0].scenario
    with pytest.raises(ScriptError) as caught:
        parse_script(text, "s")
    told = {problem.partition(": ")[2] for problem in caught.value.problems}
    assert told == {str(fault) for fault in faults(scenario)}
    assert told == {problem.split(": ", 2)[2] for problem in problems_of(write_json([scenario]))}


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["scenarios", "slug", "locations", "groups", "events", "pairs", "id", "agents", "name"]),
            inner,
            max_size=5,
        )
    ),
    max_leaves=25,
)


@given(json_values)
def test_any_json_is_read_or_refused_but_never_crashes(value: Any) -> None:
    with contextlib.suppress(ScriptError):
        assert parse_json(json.dumps(value), "s.json")


def test_half_a_surrogate_pair_cannot_enter() -> None:
    data = document()
    data["scenarios"][0]["sentence"] = "a crowd \ud83d"
    (scenario,) = parse_json(json.dumps(data), "s")
    assert scenario.sentence == "a crowd ?"


def written(folder: Path, text: str) -> Path:
    path = folder / "layout"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "text",
    [
        SCRIPT,
        "\n".join(line for line in SCRIPT.splitlines() if line.startswith("L:")),
        write_json(parse_script(SCRIPT, "s")),
        json.dumps({"locations": document()["scenarios"][0]["locations"]}),
        SCRIPT.replace("S: At the kiosk a woman buys a paper.", "").replace("wait@hall", "dance@hall"),
    ],
    ids=["script", "locations only", "json", "json locations only", "script with faults elsewhere"],
)
def test_an_environment_is_read_from_a_script_or_json(tmp_path: Path, text: str) -> None:
    environment = read_environment(written(tmp_path, text))
    assert environment == parse_script(SCRIPT, "s")[0].environment


@pytest.mark.parametrize("text", ["L: hall | room | 0,0 | 2x2", '{"locations": []}', "=== empty"])
def test_an_environment_of_fewer_than_two_places_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(LayoutError, match=r"environment with [01] location\(s\); a crowd needs at least two"):
        read_environment(written(tmp_path, text))


def test_faults_of_an_environment_are_told(tmp_path: Path) -> None:
    with pytest.raises(ScriptError, match=r"layout:1: unknown category 'rom'"):
        read_environment(written(tmp_path, "L: hall | rom | 0,0 | 2x2\nL: bar | item | 0,0 | 2x2"))
    with pytest.raises(ScriptError, match=r"layout:2: not understood: 'bar | item | 0,0 | 2x2'"):
        read_environment(written(tmp_path, "L: hall | room | 0,0 | 2x2\nbar | item | 0,0 | 2x2"))


def test_script_and_json_are_told_apart_by_content(tmp_path: Path, authored: tuple[Scenario, ...]) -> None:
    path = tmp_path / "s.txt"
    path.write_text(write_json(authored[:2]), encoding="utf-8")
    assert [draft.scenario for draft in read_drafts(path)] == list(authored[:2])
