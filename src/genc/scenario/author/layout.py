"""Q1: the layout of a place from one sentence (Gen-C, Bootstrapping Crowd Scenarios via LLMs)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from genc.errors import ScriptError
from genc.scenario.author.dialogue import N_ASKS, ask_until_sound
from genc.scenario.author.examples import layout_example
from genc.scenario.author.prompts import prompt
from genc.scenario.author.replies import Layout, schema_of
from genc.scenario.exchange import json_drafts
from genc.scenario.faults import Fault
from genc.scenario.scenario import Environment, Location, Scenario
from genc.words.language import LanguageModel, Question
from genc.words.vocabulary import CATEGORIES, Category

FEWEST_LOCATIONS, MOST_LOCATIONS = 6, 30
SMALLEST_PLAN_M, LARGEST_PLAN_M = 10.0, 400.0
LARGE_M2 = 40.0
"""Up to here furniture, items, exhibits and service areas are solid (docs/conventions.md)."""
_THINGS = (Category.FURNITURE, Category.ITEM, Category.EXHIBIT, Category.SERVICE_AREA)


def ask_layout(model: LanguageModel, sentence: str, examples: Sequence[Scenario], n_asks: int = N_ASKS) -> Environment:
    """A layout for the sentence, in which the plan room can place people.

    Raises:
        ScriptError: with what was wrong with the last reply, if none could be used.
    """
    shown = "\n\n".join(map(layout_example, examples))
    words = {"categories": ", ".join(CATEGORIES), "fewest": FEWEST_LOCATIONS, "most": MOST_LOCATIONS}
    turns = prompt("environment", sentence=sentence, examples=shown, **words)
    question = Question(turns, schema_of(Layout), subject=sentence, step="environment")
    known = {example.environment for example in examples}

    def read(text: str) -> Environment:
        environment = read_layout(text)
        if environment in known:
            raise ScriptError(["reply: the plan of an example; make one for the sentence"])
        return environment

    return ask_until_sound(model, question, read, n_asks)


def read_layout(text: str) -> Environment:
    """The environment of a reply to Q1.

    Raises:
        ScriptError: with every problem.
    """
    draft = json_drafts(text, "reply")[0]
    environment = draft.scenario.environment
    found = [fault for fault in draft.faults() if fault.path[:1] == ("locations",)]
    if found := found or list(layout_faults(environment)):
        raise ScriptError(draft.lines(found))
    return environment


def layout_faults(environment: Environment) -> Iterator[Fault]:
    """What makes a layout a poor place for a crowd, though it could be read."""
    places = environment.locations
    if not FEWEST_LOCATIONS <= len(places) <= MOST_LOCATIONS:
        yield Fault((), f"{len(places)} locations", f"write {FEWEST_LOCATIONS} to {MOST_LOCATIONS}")
    if not any(place.category is Category.ENTRANCE for place in places):
        yield Fault((), "no entrance", "people come from somewhere: add one at an edge")
    if places and not SMALLEST_PLAN_M <= (extent_m := _extent_m(places)) <= LARGEST_PLAN_M:
        how = f"make it {SMALLEST_PLAN_M:g} to {LARGEST_PLAN_M:g} m"
        yield Fault((), f"the whole plan is {extent_m:g} m across", how)
    solid = [(i, place) for i, place in enumerate(places) if _is_thing(place)]
    for (_, one), (i, other) in combinations(solid, 2):
        if _overlap(one, other):
            yield Fault(("locations", i), f"{other.name!r} overlaps {one.name!r}", "both are solid: move one of them")


def _is_thing(place: Location) -> bool:
    return place.category in _THINGS and math.prod(place.size_m) <= LARGE_M2


def _overlap(one: Location, other: Location) -> bool:
    return all(
        abs(a - b) < (wide + broad) / 2 - 1e-6
        for a, b, wide, broad in zip(one.position_m, other.position_m, one.size_m, other.size_m, strict=True)
    )


def _extent_m(places: Sequence[Location]) -> float:
    """The longer side of the whole plan."""
    lows = [[p.position_m[axis] - p.size_m[axis] / 2 for p in places] for axis in (0, 1)]
    highs = [[p.position_m[axis] + p.size_m[axis] / 2 for p in places] for axis in (0, 1)]
    return max(max(high) - min(low) for low, high in zip(lows, highs, strict=True))
