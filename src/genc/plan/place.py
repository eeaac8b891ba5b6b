"""Which concrete location each occasion happens at: a beam search along the occasions of a group.

Its cost weighs what the paper's map cannot: the way to walk, what the place means for the sentence, how full it is.
Staying costs nothing, so people use the counter they have queued at and read where they sit.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.plan.occasion import Occasion
from genc.plan.venue import Venue
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action, Category

BEAM = 8
_WALK_M = 25.0
"""Metres of walking that cost as much as one unit of anything else."""
_MEANING = 4.0
"""Cost of a cosine of 1 less."""
_CROWDING = 0.8
"""Cost of a place that has as many comers as it has room."""
_CHANCE = 0.5
"""Spread of a group's own taste for each place."""

SUBSTITUTES: dict[Category, tuple[Category, ...]] = {
    Category.BUILDING: (Category.ROOM, Category.ENTRANCE, Category.OUTDOOR_AREA),
    Category.ROOM: (Category.BUILDING, Category.OUTDOOR_AREA, Category.FURNITURE),
    Category.ENTRANCE: (Category.BUILDING,),
    Category.EXHIBIT: (Category.ITEM, Category.FURNITURE, Category.OUTDOOR_AREA, Category.ROOM),
    Category.FURNITURE: (Category.ITEM, Category.ROOM, Category.OUTDOOR_AREA),
    Category.OUTDOOR_AREA: (Category.ROOM, Category.BUILDING, Category.FURNITURE),
    Category.ITEM: (Category.EXHIBIT, Category.FURNITURE, Category.SERVICE_AREA),
    Category.SERVICE_AREA: (Category.ITEM, Category.FURNITURE, Category.BUILDING),
}
"""What stands in for a category that a layout lacks, best first; after these, any place at all."""

WAY_IN = "way in"


def with_way_in(environment: Environment) -> Environment:
    """The same environment, with an entrance at its edge if it has none."""
    if any(place.category is Category.ENTRANCE for place in environment.locations):
        return environment
    places = environment.locations
    left = min(place.position_m[0] - place.size_m[0] / 2 for place in places)
    y = float(np.mean([place.position_m[1] for place in places]))
    name = WAY_IN if WAY_IN not in environment else f"{WAY_IN} at the edge"
    return Environment((*places, Location(name, Category.ENTRANCE, (left - 2.0, y), (3.0, 4.0))))


@dataclass(frozen=True, eq=False)
class Chooser:
    """Chooses locations in one environment.

    Attributes:
        affinity: `[n_groups, n_locations]` how well each location's name suits each group's text, or None.
    """

    venue: Venue
    affinity: NDArray[np.float64] | None

    def choose(self, occasions: Sequence[Occasion], rng: np.random.Generator) -> tuple[list[int], list[str]]:
        """The location index of every occasion, and a note for every category that had to be replaced."""
        candidates = {category: self._candidates(category) for category in {o.category for o in occasions}}
        walk = (self.venue.ways_m / _WALK_M).tolist()
        room = [max(1, len(place.service) or len(place.spots) // 4) for place in self.venue.places]
        load: Counter[int] = Counter()
        chosen: list[int] = []
        for group in _by_group(occasions):
            own = self._taste(group[0].group, rng)
            taste = [t + _CROWDING * load[i] / room[i] for i, t in enumerate(own)]
            picked = _search(group, [self._options(o, candidates) for o in group], walk, taste)
            for occasion, place in zip(group, picked, strict=True):
                load[place] += len(occasion.agents)
            chosen.extend(picked)
        return chosen, self._notes(candidates)

    def _options(self, occasion: Occasion, candidates: dict[Category, list[int]]) -> list[int]:
        if occasion.wished is not None and occasion.wished in self.venue.environment:
            return [self.venue.environment.locations.index(self.venue.environment[occasion.wished])]
        found = candidates[occasion.category]
        lacking = self.venue.environment.locations[found[0]].category is not occasion.category
        # who goes out or comes in, and lacks the place for it, uses an entrance
        return self._candidates(Category.ENTRANCE) if lacking and occasion.action is Action.ENTER_EXIT else found

    def _candidates(self, category: Category) -> list[int]:
        for wanted in (category, *SUBSTITUTES[category]):
            found = [i for i, place in enumerate(self.venue.environment.locations) if place.category is wanted]
            if found:
                return found
        return list(range(len(self.venue.places)))

    def _taste(self, group: int, rng: np.random.Generator) -> list[float]:
        taste = -_CHANCE * rng.gumbel(size=len(self.venue.places))
        if self.affinity is not None:
            taste = taste - _MEANING * self.affinity[group]
        return [float(t) for t in taste]

    def _notes(self, candidates: dict[Category, list[int]]) -> list[str]:
        notes = []
        for category, found in sorted(candidates.items()):
            stand_in = self.venue.environment.locations[found[0]].category
            if stand_in is not category:
                notes.append(f"this environment has no {category}: {stand_in} stands in for it")
        return notes


def _search(
    group: Sequence[Occasion], options: Sequence[Sequence[int]], walk: Sequence[Sequence[float]], taste: Sequence[float]
) -> list[int]:
    """The cheapest locations found for a group's occasions; exact as long as the beam holds all combinations."""
    beam: list[tuple[float, dict[int, int], list[int]]] = [(0.0, {}, [])]
    for occasion, places in zip(group, options, strict=True):
        grown = []
        for cost, at, picked in beam:
            for place in places:
                before = [at.get(agent, place) for agent in occasion.agents]
                stays = all(b == place for b in before) and bool(picked)
                step = sum(walk[b][place] for b in before) / len(before)
                # a place is judged once, when it is come to
                step += 0.0 if stays and occasion.action is not Action.ENTER_EXIT else 0.3 * taste[place]
                grown.append((cost + step, at, picked, place))
        grown.sort(key=lambda option: option[0])
        beam = [
            (cost, {**at, **dict.fromkeys(occasion.agents, place)}, [*picked, place])
            for cost, at, picked, place in grown[:BEAM]
        ]
    return beam[0][2]


def _by_group(occasions: Sequence[Occasion]) -> list[list[Occasion]]:
    groups: dict[int, list[Occasion]] = {}
    for occasion in occasions:
        groups.setdefault(occasion.group, []).append(occasion)
    return list(groups.values())
