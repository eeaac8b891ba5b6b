"""Q2: what people do, from one sentence and the names of the locations (Gen-C, Bootstrapping Crowd Scenarios)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from genc.errors import ScriptError
from genc.scenario.author.dialogue import N_ASKS, ask_until_sound
from genc.scenario.author.examples import events_example
from genc.scenario.author.prompts import prompt
from genc.scenario.author.replies import Happenings, schema_of
from genc.scenario.exchange import json_drafts
from genc.scenario.faults import Fault
from genc.scenario.scenario import Scenario
from genc.words.language import LanguageModel, Question
from genc.words.vocabulary import ACTIONS, MAX_EVENTS, MAX_NODES


@dataclass(frozen=True)
class Wish:
    """How much is to be written.

    Attributes:
        words: the size, as the prompt says it.
        fewest_groups: fewer are not accepted.
    """

    words: str
    fewest_groups: int = 1

    @staticmethod
    def of_groups(n_groups: int) -> Wish:
        """About so many groups, of which at least half have to be there."""
        return Wish(f"about {n_groups} groups, about {2 * n_groups} people in all", (n_groups + 1) // 2)

    @staticmethod
    def of_agents(n_agents: int) -> Wish:
        """A crowd of so many people; how many there are, the reply shows."""
        return Wish(f"as many groups as it takes for exactly {n_agents} people in all")


def ask_events(
    model: LanguageModel,
    stage: Scenario,
    wish: Wish,
    examples: Sequence[Scenario],
    n_asks: int = N_ASKS,
    n_before: int = 0,
) -> Scenario:
    """The scenario with the groups that the model writes for its sentence and environment.

    Args:
        model: who is asked.
        stage: sentence and environment; its groups are not looked at.
        wish: how much is to be written.
        examples: scenarios of which a part is shown.
        n_asks: questions until the events are given up.
        n_before: crowds that were asked for with these very words before: another reply is wanted.

    Raises:
        ScriptError: with what was wrong with the last reply, if none could be used.
    """
    names = [location.name for location in stage.environment.locations]
    turns = prompt(
        "events",
        sentence=stage.sentence,
        locations=" | ".join(names),
        actions=", ".join(ACTIONS),
        most_events=MAX_EVENTS,
        most_nodes=MAX_NODES,
        size=wish.words,
        examples="\n\n".join(map(events_example, examples)),
    )
    schema = schema_of(Happenings, names)
    question = Question(turns, schema, n_before * N_ASKS, subject=stage.sentence, step="events")
    return ask_until_sound(model, question, lambda text: read_events(text, stage, wish), n_asks)


def read_events(text: str, stage: Scenario, wish: Wish) -> Scenario:
    """The scenario with the groups of a reply to Q2.

    Raises:
        ScriptError: with every problem.
    """
    draft = json_drafts(text, "reply")[0]
    draft = replace(draft, scenario=replace(stage, groups=draft.scenario.groups))
    found = [fault for fault in draft.faults() if fault.path[:1] == ("groups",)]
    if found := found or [*_double_bookings(draft.scenario), *_too_few(draft.scenario, wish)]:
        raise ScriptError(draft.lines(found))
    return draft.scenario


def _too_few(scenario: Scenario, wish: Wish) -> Iterator[Fault]:
    if len(scenario.groups) < wish.fewest_groups:
        yield Fault(("groups",), f"only {len(scenario.groups)} groups", f"write {wish.words}")


def _double_bookings(scenario: Scenario) -> Iterator[Fault]:
    """Agents who would have to be in two events that begin at the same moment (Gen-C, Prompt Engineering)."""
    for g, group in enumerate(scenario.groups):
        begun: dict[tuple[str, int | None], int] = {}
        for i, event in enumerate(group.events):
            for agent in event.agents:
                other = begun.setdefault((agent, event.after), event.id)
                if other != event.id:
                    what = f"events {other} and {event.id} begin together and both need agent {agent!r}"
                    yield Fault(("groups", g, "events", i), what, f'let one wait for the other: "after": {other}')
