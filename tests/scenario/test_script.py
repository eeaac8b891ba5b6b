from __future__ import annotations

from pathlib import Path

import pytest
from drawn_scenarios import scenarios
from hypothesis import given
from hypothesis import strategies as st

from genc.errors import ScriptError
from genc.scenario.corpus import SHIPPED
from genc.scenario.faults import faults
from genc.scenario.scenario import Scenario
from genc.scenario.script import parse_script, read_script, write_script
from genc.words.vocabulary import Action, Category

SMALL = """\
T: train station

=== kiosk
S: At the kiosk a woman buys a paper while two friends meet.
L: hall | room | 10,5 | 20x10
L: kiosk | service area | 4,2.5 | 3 x 2
# a comment
G: a woman buys a paper
1 - a: queue@kiosk, object interact@kiosk
G: two friends meet and wander off
2 - a: wait@hall
3 - b: enter/exit@hall
4 >3 ab: meet@hall, wander@hall
"""
LINES = SMALL.splitlines()


def problems_of(text: str) -> tuple[str, ...]:
    with pytest.raises(ScriptError) as caught:
        parse_script(text, "s.txt")
    return caught.value.problems


def with_line(number: int, line: str) -> str:
    return "\n".join([*LINES[: number - 1], line, *LINES[number:]])


def test_a_small_script_means_what_it_says() -> None:
    (scenario,) = parse_script(SMALL, "s.txt")
    assert (scenario.slug, scenario.theme, scenario.paraphrases) == ("kiosk", "train station", ())
    kiosk = scenario.environment["kiosk"]
    assert (kiosk.category, kiosk.position_m, kiosk.size_m) == (Category.SERVICE_AREA, (4, 2.5), (3, 2))
    joint = scenario.groups[1].events[2]
    assert (joint.id, joint.agents, joint.after) == (4, ("a", "b"), 3)
    assert joint.pairs == ((Action.MEET, "hall"), (Action.WANDER, "hall"))


@given(st.lists(scenarios(), min_size=1, max_size=3, unique_by=lambda s: s.slug))
def test_written_scenarios_are_read_back_equal(drawn: list[Scenario]) -> None:
    assert all(faults(scenario) == [] for scenario in drawn)
    assert parse_script(write_script(drawn), "s.txt") == tuple(drawn)


@pytest.mark.parametrize("path", sorted(SHIPPED.rglob("*.txt")), ids=lambda p: f"{p.parent.name}-{p.stem}")
def test_every_shipped_script_is_read_back_equal(path: Path) -> None:
    scenarios = read_script(path)
    assert parse_script(write_script(scenarios), "again") == scenarios


@pytest.mark.parametrize(
    ("number", "line", "expected"),
    [
        (3, "=== ", ["s.txt:3: no name; begin it with a line '=== short-name'"]),
        (4, "", ["s.txt:3: no sentence (S:); say in one line"]),
        (4, LINES[3] + "\nS: twice", ["s.txt:5: a second sentence (S:); keep one"]),
        (4, LINES[3] + "\nP:", ["s.txt:5: an empty paraphrase (P:); fill it"]),
        (5, "L: hall | rom | 10,5 | 20x10", ["s.txt:5: unknown category 'rom'; did you mean 'room'?"]),
        (5, "L: hall | room | 10 | 20x10", ["s.txt:5: location not understood: 'hall | room | 10 | 20x10'"]),
        (5, "L: hall | room | 10,5 | 20x-1", ["s.txt:5: size 20 x -1 m is not positive"]),
        (5, "L: hall | room | nan,5 | 20x1", ["s.txt:5: position or size is not a finite number"]),
        (6, "L: hall | item | 4,2 | 1x1\n" + LINES[5], ["s.txt:6: a second location named 'hall'"]),
        (9, "1 - a: quue@kiosk", ["s.txt:9: unknown action 'quue'; did you mean 'queue'?"]),
        (9, "1 - a: sing@kiosk", ["s.txt:9: unknown action 'sing'; known are: wait, sit, wander"]),
        (9, "1 - a: wait@kisok", ["s.txt:9: event 1: unknown location 'kisok'; did you mean 'kiosk'?"]),
        (9, "1 - a: wait@moon", ["s.txt:9: event 1: unknown location 'moon'; known are: hall, kiosk"]),
        (9, "1 - a: wait", ["s.txt:9: 'wait' has no place; write action@location"]),
        (9, "1 - a: wait@hall,", ["s.txt:9: '' has no place"]),
        (9, "1 - aa: wait@hall", ["s.txt:9: event 1 names agent 'a' twice"]),
        (9, "1 - b: wait@hall", ["s.txt:8: the agents are called b; letters run without a gap: a"]),
        (9, "1 - A: wait@hall", ["s.txt:8: the agents are called A"]),
        (9, "1 a: wait@hall", ["s.txt:9: event not understood: '1 a: wait@hall'; write it as '3 >2 ab"]),
        (9, "hello", ["s.txt:9: not understood: 'hello'; a line begins with", "s.txt:8: a group without ev"]),
        (9, "", ["s.txt:8: a group without events"]),
        (8, "G:", ["s.txt:8: a group without caption"]),
        (8, "", ["s.txt:9: an event before any group; begin the group with 'G: caption'"]),
        (9, "2 - a: wait@hall", ["s.txt:11: event number 2 is used twice; 5 is free"]),
        (9, "1 >9 a: wait@hall", ["s.txt:9: event 1 waits for event 9, which does not exist"]),
        (9, "1 >4 a: wait@hall\n5 >5 a: wait@hall", ["s.txt:10: events wait for each other in a circle: 5 > 5"]),
        (12, "3 >4 b: wait@hall", ["s.txt:12: events wait for each other in a circle: 3 > 4 > 3"]),
        (13, "4 - a: wait@hall", ["s.txt:10: the group falls apart: a | b never share an event"]),
        (9, "1 - a: " + ", ".join(["wait@hall"] * 101), ["s.txt:8: 101 nodes (agents x pairs"]),
        (9, "1 - abcdefghijklmnop: wait@hall", ["s.txt:8: 16 people in a group; at most 15"]),
        (
            9,
            "\n".join(f"{i} - a: wait@hall" for i in range(10, 41)),
            ["s.txt:8: 31 events in a group; at most 30"],
        ),
    ],
)
def test_each_fault_is_told_with_its_line_and_its_remedy(number: int, line: str, expected: list[str]) -> None:
    found = problems_of(with_line(number, line))
    assert len(found) == len(expected), found
    for problem, beginning in zip(sorted(found), sorted(expected), strict=True):
        assert problem.startswith(beginning)
        assert "; " in problem


def test_all_faults_of_a_text_are_told_at_once_in_order_of_lines() -> None:
    text = """\
S: before any header
=== kiosk
L: hall | room | 1;2 | 20x10
L: gate | entrnce | 1,2 | 3x1
G: somebody
1 - a: wait@hall, sleep@hall
2 >7 a: wait@gate
3 >2 c: look at@gat
nonsense
4 - a wait@hall
=== kiosk
S: again
"""
    found = problems_of(text)
    assert [problem.split(":")[1] for problem in found] == [
        *("1", "1", "1"),
        *("2", "3", "4", "6", "7", "8", "9", "10"),
        *("11", "11", "11"),
    ]
    assert "a second scenario named 'kiosk', first at s.txt:2" in "\n".join(found)


def test_a_garbled_event_is_not_blamed_on_others() -> None:
    """Its number still exists and its agents are unknown, so neither triggers nor letters are in doubt."""
    found = problems_of(with_line(12, "3 b: enter/exit@hall"))
    assert len(found) == 1
    assert found[0].startswith("s.txt:12: event not understood")


@pytest.mark.parametrize("text", ["", "\n\n", "# only a comment\n", "T: train station\n", "Dear all,\n\nsee you there"])
def test_a_text_without_scenario_is_refused(text: str) -> None:
    assert problems_of(text) == ("s.txt: no scenario in it; begin one with a line '=== short-name'",)


def test_line_ends_tabs_and_a_byte_order_mark_do_not_matter(tmp_path: Path) -> None:
    path = tmp_path / "s.txt"
    text = SMALL.replace("\n", "\r\n").replace("G: ", "G:\t").replace("1 - a: ", "1\t-  a:")
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert read_script(path) == parse_script(SMALL, "s.txt")


def test_service_station_is_another_name_of_service_area() -> None:
    assert parse_script(SMALL.replace("service area", "service station"), "s") == parse_script(SMALL, "s")


def test_a_theme_line_holds_until_the_next_one() -> None:
    later = SMALL.replace("=== kiosk", "=== again").replace("T: train station\n\n", "T: airport\n")
    below = SMALL.replace("T: train station\n\n", "").replace("=== kiosk", "=== third\nT: metro")
    assert [s.theme for s in parse_script(SMALL + later + below, "s")] == ["train station", "airport", "metro"]


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("none.txt", None, "none.txt: no such file"),
        (".", None, "a folder, not a file"),
        ("latin.txt", "S: café".encode("latin-1"), "latin.txt: not UTF-8 text (byte 6); save it as UTF-8"),
    ],
)
def test_a_file_that_cannot_be_read(tmp_path: Path, name: str, content: bytes | None, expected: str) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ScriptError) as caught:
        read_script(tmp_path / name)
    assert len(caught.value.problems) == 1
    assert expected in str(caught.value)


@given(st.text(max_size=300) | st.lists(st.sampled_from(LINES), max_size=30).map("\n".join))
def test_any_text_is_read_or_refused_but_never_crashes(text: str) -> None:
    told: tuple[str, ...] = ()
    try:
        assert parse_script(text, "s.txt")
    except ScriptError as error:
        told = error.problems
    assert all("\n" not in problem and problem.startswith("s.txt") for problem in told)
