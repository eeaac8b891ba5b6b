"""Occasions: what the people of a group do together (or one alone) at one turn of one event."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from genc.scenario.record import Record, Step
from genc.words.vocabulary import Action, Category


@dataclass(frozen=True)
class Occasion:
    """One doing of one to fifteen people.

    Attributes:
        number: its index among all occasions of the crowd; within a group in order of event, then turn.
        group, event: where it comes from; events are numbered as the records number them.
        agents: people of the crowd, ascending.
        wished: the name of the place the author had in mind, or None.
        is_first, is_last: whether it is the first or last turn of its event.
    """

    number: int
    group: int
    event: int
    agents: tuple[int, ...]
    action: Action
    category: Category
    wished: str | None
    is_first: bool
    is_last: bool


def occasions_of(groups: Sequence[Sequence[Record]]) -> list[Occasion]:
    """The occasions of all groups; people are numbered over the crowd by group, then agent."""
    found: list[Occasion] = []
    first_agent = 0
    for group, records in enumerate(groups):
        together: dict[tuple[int, int], tuple[list[int], Step]] = {}
        for place, record in enumerate(records):
            turn, event = 0, -1
            for step in record.steps:
                turn, event = (turn + 1, event) if step.event == event else (0, step.event)
                together.setdefault((event, turn), ([], step))[0].append(first_agent + place)
        keys = sorted(together)
        for i, (event, turn) in enumerate(keys):
            agents, step = together[event, turn]
            is_last = i + 1 == len(keys) or keys[i + 1][0] != event
            number = len(found)
            found.append(
                Occasion(
                    number, group, event, tuple(agents), step.action, step.category, step.location, turn == 0, is_last
                )
            )
        first_agent += len(records)
    return found


def rows_of(occasions: Sequence[Occasion]) -> dict[int, list[int]]:
    """For each person, the numbers of their occasions in order."""
    rows: dict[int, list[int]] = {}
    for occasion in occasions:
        for agent in occasion.agents:
            rows.setdefault(agent, []).append(occasion.number)
    return rows
