"""The vanilla source: a language model asked for whole crowds, with nothing learned in between.

What a learned generator is to be compared with (Gen-C, Rationale for a Dedicated Learned Generator). A crowd costs
tokens and seconds, and may not have as many people as were asked for.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from genc.graph.codec import canonical
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.scenario.author.events import Wish, ask_events
from genc.scenario.author.layout import ask_layout
from genc.scenario.rehearse import rehearse
from genc.scenario.scenario import Environment, Scenario
from genc.words.brief import Brief
from genc.words.language import LanguageModel

TOLERANCE = (0.8, 1.2)
"""A crowd is valid if the people in it are so many times those asked for."""
MOST_GROUPS = 30
"""Asked for at once; more come in another crowd."""


@dataclass(frozen=True, eq=False)
class Vanilla:
    """A `GraphSource` that asks Q1 for each sentence once, and Q2 for as many groups as its briefs ask for.

    Counts and frequencies of a brief are not passed on: Q2 knows none of them.

    Attributes:
        model: who is asked; with a journal (`genc.words.journalled`) nothing is paid for twice.
        examples: scenarios shown in the questions.
        n_asks: questions until a layout or the events are given up.
        stages: sentences with layouts that are known already, and those that were asked for.
    """

    model: LanguageModel
    examples: Sequence[Scenario] = ()
    n_asks: int = 1
    stages: dict[str, Scenario] = field(default_factory=dict)

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief; those of one sentence are written together, as one crowd or more.

        Raises:
            ScriptError: if no reply could be used.
            ProviderError: if the model does not answer.
        """
        asking: defaultdict[str, list[int]] = defaultdict(list)
        for i, brief in enumerate(briefs):
            asking[brief.text].append(i)
        answers: dict[int, CrowdGraph] = {}
        for text, rows in asking.items():
            groups: list[CrowdGraph] = []
            n_crowds = 0
            while len(groups) < len(rows):
                wish = Wish.of_groups(min(len(rows) - len(groups), MOST_GROUPS))
                groups += self._written(text, replace(wish, fewest_groups=1), rng, n_crowds)
                n_crowds += 1
            answers |= zip(rows, groups, strict=False)
        return [answers[i] for i in range(len(briefs))]

    def crowd(self, text: str, n_agents: int, rng: np.random.Generator) -> list[CrowdGraph]:
        """The groups of one crowd of about so many people; `is_valid` says whether they are as many as they should be.

        Raises:
            ScriptError: if no reply could be used.
            ProviderError: if the model does not answer.
        """
        return self._written(text, Wish.of_agents(n_agents), rng)

    def stage(self, text: str) -> Scenario:
        """The sentence with its layout, asked for once."""
        if text not in self.stages:
            bare = Scenario("vanilla", "vanilla", text, (), Environment(()), ())
            self.stages[text] = replace(bare, environment=ask_layout(self.model, text, self.examples, self.n_asks))
        return self.stages[text]

    def _written(self, text: str, wish: Wish, rng: np.random.Generator, n_before: int = 0) -> list[CrowdGraph]:
        scenario = ask_events(self.model, self.stage(text), wish, self.examples, self.n_asks, n_before)
        return [canonical(group) for group in weave(rehearse(scenario, rng).records).groups()]


def is_valid(groups: Sequence[CrowdGraph], n_agents: int) -> bool:
    """Whether there are 0.8 to 1.2 times as many people as were asked for."""
    low, high = TOLERANCE
    return low * n_agents <= sum(group.n_agents for group in groups) <= high * n_agents
