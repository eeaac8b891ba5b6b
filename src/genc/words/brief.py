"""`Brief`: everything a generator may be told about one group (Gen-C, Graph-Level Conditioning)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from genc.errors import BriefError
from genc.words.vocabulary import ACTIONS, MAX_AGENTS, MAX_EVENTS, MAX_NODES

LONGEST_TEXT = 20_000
"""Characters. An encoder reads the first few hundred words; far beyond that the input is not a sentence."""


@dataclass(frozen=True)
class Brief:
    """The sentence S_in and, each optional, every other condition of the paper.

    Attributes:
        text: one sentence, or a caption of one group.
        n_agents: people in the group, 1 to 15.
        n_events: events of the group, 1 to 30.
        n_nodes: nodes (one person doing one thing), 1 to 100.
        action_frequencies: the share of each of the 13 actions among the nodes; sums to 1.

    Raises:
        BriefError: for an empty text or a condition that no group can meet.
    """

    text: str
    n_agents: int | None = None
    n_events: int | None = None
    n_nodes: int | None = None
    action_frequencies: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        if not self.text.strip():
            raise BriefError("the sentence is empty: say where it is, who is there and what they do")
        if any("\ud800" <= letter <= "\udfff" for letter in self.text):
            raise BriefError("the sentence holds bytes that are no UTF-8 text: write it in UTF-8")
        if len(self.text) > LONGEST_TEXT:
            raise BriefError(f"the sentence has {len(self.text)} characters; at most {LONGEST_TEXT} can be read")
        self._check_count("agents", self.n_agents, MAX_AGENTS)
        self._check_count("events", self.n_events, MAX_EVENTS)
        self._check_count("nodes", self.n_nodes, MAX_NODES)
        least = max(1, (self.n_events or 1) + (self.n_agents or 1) - 1)
        if self.n_nodes is not None and self.n_nodes < least:
            raise BriefError(
                f"{self.n_nodes} nodes are too few for {self.n_agents or 1} agents in {self.n_events or 1}"
                f" events that tie them together: ask for at least {least}"
            )
        if self.n_nodes and self.n_agents and self.n_events == 1 and self.n_nodes % self.n_agents:
            raise BriefError(
                f"{self.n_agents} agents in one event do the same number of things each, which {self.n_nodes} nodes do "
                f"not give: ask for a multiple of {self.n_agents}, or for more events"
            )
        if self.action_frequencies is not None:
            self._check_frequencies(self.action_frequencies)

    @staticmethod
    def _check_count(what: str, value: int | None, most: int) -> None:
        if value is not None and not 1 <= value <= most:
            raise BriefError(f"a group of {value} {what} cannot be made: ask for 1 to {most}")

    @staticmethod
    def _check_frequencies(values: tuple[float, ...]) -> None:
        if len(values) != len(ACTIONS):
            raise BriefError(f"{len(values)} action frequencies given; there are {len(ACTIONS)} actions")
        if any(not math.isfinite(v) or v < 0 for v in values) or abs(sum(values) - 1) > 1e-3:
            raise BriefError(f"action frequencies must be shares that sum to 1, not {sum(values):.3f}")
