"""Few-shot examples out of authored scenarios: which ones, and what is shown of them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from genc.scenario.exchange import write_json
from genc.scenario.scenario import Group, Scenario

_N_GROUPS = 5
"""Groups shown of a scenario: enough for the manner, few enough for the price."""


def draw(corpus: Sequence[Scenario], n: int, seed: int, subject: str) -> list[Scenario]:
    """Up to n scenarios, drawn anew for each subject; the same seed and subject give the same ones."""
    rng = np.random.default_rng([seed, int(hashlib.sha256(subject.encode("utf-8", "replace")).hexdigest()[:16], 16)])
    return [corpus[i] for i in rng.permutation(len(corpus))[:n].tolist()]


def layout_example(scenario: Scenario) -> str:
    """A scenario as question and reply of Q1."""
    return f"Sentence: {scenario.sentence}\n{json.dumps({'locations': _as_json(scenario)['locations']})}"


def events_example(scenario: Scenario) -> str:
    """Some groups of a scenario as question and reply of Q2."""
    few = replace(scenario, groups=_few(scenario.groups))
    names = " | ".join(location.name for location in scenario.environment.locations)
    shown = json.dumps({"groups": _as_json(few)["groups"]}, ensure_ascii=False)
    return f"Sentence: {scenario.sentence}\nLocations: {names}\n(only {len(few.groups)} groups are shown)\n{shown}"


def _few(groups: Sequence[Group]) -> tuple[Group, ...]:
    """Groups of all sizes that wait for nobody outside, in the order written."""
    closed = [g for g in groups if {e.after for e in g.events} <= {None, *(e.id for e in g.events)}]
    by_size = sorted(closed, key=lambda group: len(group.agents))
    wanted = {round(k) for k in np.linspace(0, len(by_size) - 1, min(_N_GROUPS, len(by_size)))} if by_size else set()
    chosen = [by_size[k] for k in wanted]
    return tuple(group for group in groups if group in chosen)


def _as_json(scenario: Scenario) -> dict[str, object]:
    document: dict[str, object] = json.loads(write_json([scenario]))["scenarios"][0]
    return document
