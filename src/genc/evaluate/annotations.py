"""Annotations of real video: who does what in each window of five seconds (Gen-C, Assessment of LLM-bootstrapped Data).

A CSV file of `clip,window,person,action`; `docs/assessment.md` describes it. The shipped example is invented: it shows
the format and lets the command run.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from genc.errors import StudyError
from genc.evaluate.csv_rows import read_rows, settle
from genc.evaluate.sequences import ActionSequence
from genc.scenario.faults import suggest
from genc.words.vocabulary import ACTION_INDEX, ACTIONS, Action, parse_action

SYNTHETIC_ANNOTATIONS = Path(__file__).parent / "study" / "synthetic_annotations.csv"
"""Invented: no video was looked at."""

_COLUMNS = ("clip", "window", "person", "action")
_MAX_WINDOW_DIGITS = 6
"""Of five seconds each: more than a clip has, and less than would take forever to read."""


@dataclass(frozen=True)
class Track:
    """One person of a clip, in view without a break: an action for each window from `first_window` on."""

    clip: str
    person: str
    first_window: int
    actions: ActionSequence


def read_annotations(path: Path | str) -> list[Track]:
    """The tracks of a CSV file, clip by clip and person by person in the order in which the file first names them.

    A window without a label breaks a person's track: what was done in it is unknown, so that nothing can be said to
    follow what came before it.

    Raises:
        StudyError: if the file cannot be read, or with every problem of it.
    """
    rows, problems = read_rows(path, _COLUMNS)
    first: dict[tuple[str, int | str, str], str] = {}
    for where, (clip, window, person, action) in rows:
        problems += [f"{where}: {problem}" for problem in _problems_of(clip, window, person, action)]
        before = first.setdefault((clip, int(window) if _is_number(window) else where, person), where)
        if before != where:
            what = f"a second label of {person!r} in window {window} of {clip!r}, first at {before}"
            problems.append(f"{where}: {what}; keep one of them")
    settle(path, rows, problems, "docs/assessment.md")
    labels: defaultdict[tuple[str, str], dict[int, int]] = defaultdict(dict)
    for _, (clip, window, person, action) in rows:
        labels[clip, person][int(window)] = ACTION_INDEX[Action(action.casefold())]
    tracks = [track for (clip, person), of_person in labels.items() for track in _tracks(clip, person, of_person)]
    if all(len(track.actions) == 1 for track in tracks):
        what = "nobody has a label in two windows one after the other, so nothing follows anything"
        raise StudyError([f"{path}: {what}; number the windows 0, 1, 2 (the second at which one begins, over 5)"])
    return tracks


def _problems_of(clip: str, window: str, person: str, action: str) -> Iterator[str]:
    if not clip:
        yield "clip is empty; give each clip any name or number"
    if not person:
        yield "person is empty; give each person of a clip any name or number"
    if not _is_number(window):
        yield f"window is {window!r}; number the windows of a clip 0, 1, 2 (the second at which one begins, over 5)"
    if not action:
        yield "action is empty; leave the row out where nothing can be told"
    elif parse_action(action.casefold()) is None:
        yield f"action is no action: {action!r}; {suggest(action, ACTIONS)}"


def _is_number(window: str) -> bool:
    return window.isascii() and window.isdecimal() and len(window) <= _MAX_WINDOW_DIGITS


def _tracks(clip: str, person: str, labels: Mapping[int, int]) -> Iterator[Track]:
    for windows in _unbroken(sorted(labels)):
        yield Track(clip, person, windows[0], tuple(labels[window] for window in windows))


def _unbroken(windows: list[int]) -> Iterator[list[int]]:
    """Ascending numbers, parted where one is missing."""
    breaks = [i for i, (one, other) in enumerate(pairwise(windows), start=1) if other != one + 1]
    for start, stop in pairwise([0, *breaks, len(windows)]):
        yield windows[start:stop]
