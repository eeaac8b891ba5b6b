"""The types of a crowd scenario (Gen-C, Overview): environment, events, groups."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from genc.words.vocabulary import Action, Category


@dataclass(frozen=True)
class Location:
    """A named place: a rectangle on the common plan.

    Attributes:
        position_m: centre (x, y) in metres.
        size_m: footprint (width along x, depth along y) in metres, both positive.
    """

    name: str
    category: Category
    position_m: tuple[float, float]
    size_m: tuple[float, float]


@dataclass(frozen=True)
class Environment:
    """The locations of one scenario; names are unique."""

    locations: tuple[Location, ...]

    def __getitem__(self, name: str) -> Location:
        return self._by_name[name]

    def __contains__(self, name: object) -> bool:
        return name in self._by_name

    @cached_property
    def _by_name(self) -> dict[str, Location]:
        return {location.name: location for location in self.locations}


@dataclass(frozen=True)
class Event:
    """Some agents of a group doing a row of things together.

    Attributes:
        id: unique in the scenario; an agent's events follow in order of id.
        agents: letters from `a`, local to the group.
        pairs: (action, location name), done in order by all agents.
        after: the event that must have ended before this one begins; None for the start of the scenario.
    """

    id: int
    agents: tuple[str, ...]
    pairs: tuple[tuple[Action, str], ...]
    after: int | None = None


@dataclass(frozen=True)
class Group:
    """People tied together by shared events, with one caption that says who they are and what they do."""

    caption: str
    events: tuple[Event, ...]

    @property
    def agents(self) -> tuple[str, ...]:
        """The letters of its agents, sorted."""
        return tuple(sorted({agent for event in self.events for agent in event.agents}))


@dataclass(frozen=True)
class Scenario:
    """One crowd scenario CS: the sentence S_in, its paraphrases, an environment and groups."""

    slug: str
    theme: str
    sentence: str
    paraphrases: tuple[str, ...]
    environment: Environment
    groups: tuple[Group, ...]

    @property
    def events(self) -> Iterator[Event]:
        """All events of all groups, in the order written."""
        return (event for group in self.groups for event in group.events)
