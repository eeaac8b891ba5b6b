"""`Record`: the paper's Rec_i, what one agent does over its life in the scene (Gen-C, Bootstrapping)."""

from __future__ import annotations

from dataclasses import dataclass, field

from genc.words.vocabulary import Action, Category


@dataclass(frozen=True)
class Step:
    """One action of one agent.

    Attributes:
        event: the event it belongs to; events are numbered from 0 in the order in which they begin.
        partners: the other agents who do this step together with this one, ascending.
        location: the concrete place the author had in mind, where there was an author. It is a note in the
            margin: a graph knows categories only, so two steps that differ in it alone are equal.
    """

    event: int
    action: Action
    category: Category
    partners: tuple[int, ...] = ()
    location: str | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Record:
    """One agent and its steps, in order."""

    agent: int
    steps: tuple[Step, ...]
