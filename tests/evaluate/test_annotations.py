from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.errors import StudyError
from genc.evaluate.annotations import SYNTHETIC_ANNOTATIONS, Track, read_annotations
from genc.words.vocabulary import ACTION_INDEX, ACTIONS

DOCS = Path(__file__).parents[2] / "docs/assessment.md"
HEADER = "clip,window,person,action"
WAIT, SIT, ENTER = (ACTION_INDEX[ACTIONS[i]] for i in (0, 1, 4))


@pytest.fixture
def write(tmp_path: Path):
    def written(*rows: str, header: str = HEADER) -> Path:
        path = tmp_path / "video.csv"
        path.write_bytes("\n".join([header, *rows]).encode())
        return path

    return written


def problems(path: Path) -> tuple[str, ...]:
    with pytest.raises(StudyError) as caught:
        read_annotations(path)
    assert all("\n" not in problem for problem in caught.value.problems)
    return caught.value.problems


def test_rows_in_any_order_become_tracks_of_persons_and_clips(write):
    path = write(
        "x,1,b,sit", "x,0,a,wait", "y,7,a,Enter/Exit", "x,0,b,SIT", 'y, 8 ,a,"wait"', "# a comment", "", "x,01,a,sit"
    )
    assert read_annotations(path) == [
        Track("x", "b", 0, (SIT, SIT)),
        Track("x", "a", 0, (WAIT, SIT)),
        Track("y", "a", 7, (ENTER, WAIT)),
    ]


def test_a_missing_window_ends_a_track_and_another_begins(write):
    path = write(*(f"x,{w},a,wait" for w in (3, 4, 6, 9, 10, 11)), "x,5,b,sit")
    found = [(track.person, track.first_window, len(track.actions)) for track in read_annotations(path)]
    assert found == [("a", 3, 2), ("a", 6, 1), ("a", 9, 3), ("b", 5, 1)]


@given(st.sets(st.tuples(st.sampled_from("xy"), st.integers(0, 12), st.sampled_from("ab")), min_size=1), st.randoms())
def test_tracks_hold_every_label_once_and_never_touch(tmp_path_factory, seen, chance):
    path = tmp_path_factory.mktemp("video") / "video.csv"
    label = {key: ACTIONS[chance.randrange(13)] for key in seen}
    rows = [f"{clip},{window},{person},{action}" for (clip, window, person), action in label.items()]
    path.write_text("\n".join([HEADER, *rows, "z,0,z,sit", "z,1,z,sit"]), encoding="utf-8")
    tracks = [track for track in read_annotations(path) if track.clip != "z"]
    told = [
        ((t.clip, t.first_window + i, t.person), ACTIONS[action]) for t in tracks for i, action in enumerate(t.actions)
    ]
    assert sorted(told) == sorted(label.items())
    ends = {(t.clip, t.person, t.first_window + len(t.actions)) for t in tracks}
    assert not ends & {(t.clip, t.person, t.first_window) for t in tracks}


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ("x,0,b", "3 cells; write 4: clip,window,person,action"),
        ("x;0;b;sit", "1 cells; write 4"),
        (",0,b,sit", "clip is empty; give each clip"),
        ("x,0,,sit", "person is empty; give each person"),
        ("x,0,b,", "action is empty; leave the row out"),
        ("x,0,b,waiting", "action is no action: 'waiting'; did you mean 'wait'?"),
        ("x,0,b,zzz", "action is no action: 'zzz'; known are: wait, sit"),
        ("x,,b,sit", "window is ''; number the windows"),
        ("x,2.5,b,sit", "window is '2.5'; number the windows"),
        ("x,-1,b,sit", "window is '-1'; number the windows"),
        ("x,٣,b,sit", "window is '٣'; number the windows"),
        ("x,1_0,b,sit", "window is '1_0'; number the windows"),
        (f"x,{'9' * 5000},b,sit", "window is '9999"),
        ("x,00,a,sit", "a second label of 'a' in window 00 of 'x', first at {path}:2; keep one of them"),
        ('x,0,"b,sit', "no CSV (unexpected end of data)"),
    ],
)
def test_each_fault_is_one_line_that_says_where_what_and_what_to_do(write, row, problem):
    path = write("x,0,a,wait", "x,1,a,wait", row)
    (said,) = problems(path)
    assert said.startswith(f"{path}:4: {problem.format(path=path)}")


def test_all_faults_are_said_at_once(write):
    assert len(problems(write(",x,,", "x,0", "x,0,a,sitt", "x,0,a,sit"))) == 7


def test_seconds_in_the_place_of_windows_are_found_out(write):
    path = write(*(f"x,{second},a,wait" for second in (0, 5, 10)))
    (said,) = problems(path)
    assert said.startswith(f"{path}: nobody has a label in two windows one after the other")


def test_files_that_are_no_annotations(write, tmp_path):
    assert problems(write(header="clip,person,window,action"))[0].endswith(f"write '{HEADER}'")
    assert "no rows" in problems(write("# nothing"))[0]
    assert "docs/assessment.md" in problems(write("# nothing"))[0]
    assert "cannot be read" in problems(tmp_path / "none.csv")[0]
    (tmp_path / "bytes.csv").write_bytes(b"clip\xff")
    assert "not UTF-8" in problems(tmp_path / "bytes.csv")[0]


def test_the_shipped_example_says_that_it_is_invented_and_has_gaps_and_single_windows():
    assert "synthetic" in SYNTHETIC_ANNOTATIONS.name
    assert SYNTHETIC_ANNOTATIONS.read_text(encoding="utf-8").startswith("# SYNTHETIC")
    tracks = read_annotations(SYNTHETIC_ANNOTATIONS)
    assert len({track.clip for track in tracks}) == 24
    assert len(tracks) > len({(track.clip, track.person) for track in tracks})
    assert {1, 15} <= {len(track.actions) for track in tracks}
    assert np.mean([len(track.actions) for track in tracks]) > 4


def test_the_example_of_the_page_reads_as_the_page_says(tmp_path):
    (example,) = re.findall(r"```csv\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.S)
    (tmp_path / "example.csv").write_text(example, encoding="utf-8")
    tracks = read_annotations(tmp_path / "example.csv")
    told = [(t.person, [str(ACTIONS[a]) for a in t.actions]) for t in tracks]
    assert told == [
        ("red coat", ["wait", "wait", "talk on phone"]),
        ("child", ["wander"]),
        ("child", ["wander", "enter/exit"]),
    ]
