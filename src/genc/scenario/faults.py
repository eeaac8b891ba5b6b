"""What can be wrong with a scenario: one checker for scripts, JSON, replies and grown scenarios alike."""

from __future__ import annotations

import difflib
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from string import ascii_lowercase

from genc.scenario.scenario import Environment, Event, Group, Scenario
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES

Path = tuple[str | int, ...]
"""Where in a scenario, spelled as in its JSON: `("groups", 1, "events", 0)` is the first event of group 1."""

LETTERS = tuple(ascii_lowercase[:MAX_AGENTS])
"""The names that agents may have within a group."""

WANTED_PARAPHRASES = 5
WANTED_GROUPS = 14
"""What a scenario of the shipped corpus has at least; fewer make a thin training set, not a wrong script."""


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong: where, what, and how to mend it."""

    path: Path
    what: str
    how: str

    def __str__(self) -> str:
        return f"{self.what}; {self.how}"


def faults(scenario: Scenario) -> list[Fault]:
    """Everything that makes a scenario unusable; empty for a sound one."""
    found = [*_text_faults(scenario), *_environment_faults(scenario.environment), *_trigger_faults(scenario)]
    used: set[int] = set()
    for g, group in enumerate(scenario.groups):
        found += _group_faults(("groups", g), group)
        for i, event in enumerate(group.events):
            path = ("groups", g, "events", i)
            if event.id in used:
                free = max(e.id for e in scenario.events) + 1
                found.append(Fault(path, f"event number {event.id} is used twice", f"{free} is free"))
            used.add(event.id)
            found += _event_faults(path, event, scenario.environment)
    return found


def _environment_faults(environment: Environment) -> list[Fault]:
    """Everything that makes an environment unusable; the paths begin at the scenario."""
    found = [] if environment.locations else [Fault((), "no location", "add at least one place (L:)")]
    names: set[str] = set()
    for i, location in enumerate(environment.locations):
        path = ("locations", i)
        if not _is_clean(location.name) or not location.name or set(location.name) & set("|,"):
            what = f"bad location name {location.name!r}"
            found.append(Fault(path, what, "use words on one line, without , and |"))
        if location.name in names:
            found.append(Fault(path, f"a second location named {location.name!r}", "give each its own name"))
        names.add(location.name)
        if not all(map(math.isfinite, (*location.position_m, *location.size_m))):
            found.append(Fault(path, "position or size is not a finite number", "write plain metres"))
        elif min(location.size_m) <= 0:
            w, d = location.size_m
            found.append(Fault(path, f"size {w:g} x {d:g} m is not positive", "write width x depth in metres"))
    return found


def hints(scenario: Scenario) -> list[Fault]:
    """What a scenario could do better; none of it makes it unusable."""
    found = []
    texts = [scenario.sentence, *scenario.paraphrases]
    if len(scenario.paraphrases) < WANTED_PARAPHRASES:
        what = f"{_few(len(scenario.paraphrases), 'paraphrase')} (P:)"
        found.append(Fault((), what, f"with {WANTED_PARAPHRASES} a model learns more than one wording"))
    if len(set(texts)) < len(texts):
        found.append(Fault((), "two of its sentences are the same", "say it in other words"))
    if len(scenario.groups) < WANTED_GROUPS:
        what = _few(len(scenario.groups), "group")
        found.append(Fault((), what, f"a scene of the corpus has {WANTED_GROUPS} or more"))
    used = {location for event in scenario.events for _, location in event.pairs}
    for i, location in enumerate(scenario.environment.locations):
        if location.name not in used:
            found.append(Fault(("locations", i), f"nobody uses {location.name!r}", "use it or leave it out"))
    return found


def suggest(word: str, known: Iterable[str]) -> str:
    """The nearest known word as a question, else the list of them."""
    by_folded = {str(k).casefold(): str(k) for k in known}
    close = difflib.get_close_matches(word.casefold(), by_folded, n=1, cutoff=0.6)
    return f"did you mean {by_folded[close[0]]!r}?" if close else f"known are: {', '.join(by_folded.values())}"


def _is_clean(text: str) -> bool:
    return text == " ".join(text.split())


def _text_faults(scenario: Scenario) -> Iterator[Fault]:
    yield from _line_faults(("slug",), scenario.slug, "no name; begin it with a line '=== short-name'")
    yield from _line_faults(("theme",), scenario.theme)
    missing = "no sentence (S:); say in one line where it is, who is there and what they do"
    yield from _line_faults(("sentence",), scenario.sentence, missing)
    for i, text in enumerate(scenario.paraphrases):
        yield from _line_faults(("paraphrases", i), text, "an empty paraphrase (P:); fill it or leave it out")
    if not scenario.groups:
        yield Fault(("groups",), "no group (G:)", "add one with at least one event")


def _line_faults(path: Path, text: str, missing: str = "") -> Iterator[Fault]:
    if missing and not text:
        yield Fault(path, *missing.split("; "))
    if not _is_clean(text):
        yield Fault(path, f"not one line with single spaces: {text[:60]!r}", "join it into one line")


def _event_faults(path: Path, event: Event, environment: Environment) -> Iterator[Fault]:
    twice = [agent for agent, n in Counter(event.agents).items() if n > 1]
    if not 0 <= event.id < 10**9:
        yield Fault(path, f"bad event number {event.id}", "count events from 1")
    if not event.agents or twice:
        what = f"names agent {twice[0]!r} twice" if twice else "has no agents"
        yield Fault(path, f"event {event.id} {what}", "name each agent who takes part once")
    if not event.pairs:
        yield Fault(path, f"event {event.id} does nothing", "add at least one action@location")
    if not environment.locations:
        return
    for i, (_, name) in enumerate(event.pairs):
        if name not in environment:
            how = suggest(name, (location.name for location in environment.locations))
            yield Fault((*path, "pairs", i), f"event {event.id}: unknown location {name!r}", how)


def _trigger_faults(scenario: Scenario) -> Iterator[Fault]:
    after = {event.id: event.after for event in scenario.events}
    path_of: dict[int, Path] = {}
    for g, group in enumerate(scenario.groups):
        for i, event in enumerate(group.events):
            path = path_of.setdefault(event.id, ("groups", g, "events", i))
            if event.after is not None and event.after not in after:
                what = f"event {event.id} waits for event {event.after}, which does not exist"
                yield Fault(path, what, "name an event of this scenario, or '-' for the start")
    for cycle in trigger_cycles(after):
        first = cycle.index(min(cycle))
        chain = " > ".join(map(str, (*cycle[first:], *cycle[: first + 1])))
        what = f"events wait for each other in a circle: {chain}"
        yield Fault(path_of[cycle[first]], what, "let one of them begin from the start ('-')")


def trigger_cycles(after: Mapping[int, int | None]) -> list[tuple[int, ...]]:
    """The circles among triggers, each once; an event waits for the one that follows it."""
    seen: set[int] = set()
    cycles = []
    for start in after:
        trail: list[int] = []
        at: int | None = start
        while at is not None and at in after and at not in seen:
            seen.add(at)
            trail.append(at)
            at = after[at]
        if at in trail:
            cycles.append(tuple(trail[trail.index(at) :]))
    return cycles


def _group_faults(path: Path, group: Group) -> Iterator[Fault]:
    missing = "a group without caption; say in one line who they are and what they do"
    yield from _line_faults((*path, "caption"), group.caption, missing)
    if not group.events:
        yield Fault((*path, "events"), "a group without events", "add one, or leave the group out")
    agents = group.agents
    if len(agents) > MAX_AGENTS:
        yield Fault(path, f"{len(agents)} people in a group", f"at most {MAX_AGENTS}: split it into several")
    elif agents != LETTERS[: len(agents)]:
        expected = ", ".join(LETTERS[: len(agents)])
        yield Fault(path, f"the agents are called {', '.join(agents)}", f"letters run without a gap: {expected}")
    parts = _parts(group)
    if len(parts) > 1:
        what = f"the group falls apart: {' | '.join(''.join(part) for part in parts)} never share an event"
        yield Fault(path, what, "give each part its own group (G:), or an event that ties them")
    n_nodes = sum(len(event.agents) * len(event.pairs) for event in group.events)
    if n_nodes > MAX_NODES:
        what = f"{n_nodes} nodes (agents x pairs, over all events) in a group"
        yield Fault(path, what, f"at most {MAX_NODES}: shorten or split it")
    if len(group.events) > MAX_EVENTS:
        yield Fault(path, f"{len(group.events)} events in a group", f"at most {MAX_EVENTS}: shorten or split it")


def _parts(group: Group) -> list[tuple[str, ...]]:
    """The agents, split into sets that no event ties together."""
    parts: list[set[str]] = []
    for event in group.events:
        touched = [part for part in parts if part.intersection(event.agents)]
        parts = [part for part in parts if part not in touched]
        parts.append(set(event.agents).union(*touched))
    return sorted(tuple(sorted(part)) for part in parts if part)


def _few(n: int, noun: str) -> str:
    return f"only {n} {noun}{'s' if n > 1 else ''}" if n else f"no {noun}s"
