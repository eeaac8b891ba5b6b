"""The masks against brute force: they admit every valid group and nothing else, and never run dry."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
import torch

from genc.graph.codec import Tokens, canonical, decode, encode, group_fault, turns_token
from genc.graph.weave import weave
from genc.model.rules import StructureRules, feasible_counts
from genc.model.tensors import GroupBatch, Steps
from genc.scenario.corpus import load_corpus
from genc.scenario.rehearse import rehearse


def by_brute_force(n_agents: int, n_events: int, n_nodes: int) -> set[tuple[int, ...]]:
    """All structures with these counts, straight from the definition."""
    found = set()

    def grow(tokens, known, parts, events, nodes):
        if events == 0:
            if nodes == 0 and known == n_agents and len(parts) == 1:
                found.add(tuple(tokens))
            return
        for new in range(n_agents - known + 1):
            for size in range(known + 1):
                for old in combinations(range(known), size):
                    members = [*old, *range(known, known + new)]
                    if not members:
                        continue
                    alone = [*parts, *({a} for a in range(known, known + new))]
                    joined = set().union(*(p for p in alone if p & set(members)))
                    apart = [p for p in alone if not p & set(members)]
                    for turns in range(1, nodes // len(members) + 1):
                        rest = nodes - len(members) * turns
                        grow([*tokens, *members, turns_token(turns)], known + new, [*apart, joined], events - 1, rest)

    grow([], 0, [], n_events, n_nodes)
    return found


def by_masks(*counts: int) -> set[tuple[int, ...]]:
    """All structures that the masks admit."""
    found = set()

    def grow(tokens):
        rules = StructureRules(*(torch.tensor([c]) for c in counts))
        for token in tokens:
            rules.advance(torch.tensor([token]))
        if rules.finished[0]:
            found.add(tuple(tokens))
            return
        allowed = rules.mask()[0].nonzero()[:, 0].tolist()
        assert allowed, f"a dead end after {tokens}"
        for token in allowed:
            grow([*tokens, token])

    grow([])
    return found


@pytest.mark.parametrize("n_agents", [1, 2, 3])
@pytest.mark.parametrize("n_events", [1, 2, 3])
def test_masks_admit_exactly_the_valid_structures(n_agents, n_events):
    feasible = feasible_counts()
    for n_nodes in range(1, 7):
        expected = by_brute_force(n_agents, n_events, n_nodes)
        assert bool(feasible[n_agents - 1, n_events - 1, n_nodes - 1]) == bool(expected)
        if expected:
            assert by_masks(n_agents, n_events, n_nodes) == expected


def test_random_structures_of_any_size_end_with_exact_counts():
    generator = torch.Generator().manual_seed(0)
    cells = feasible_counts().nonzero() + 1
    counts = cells[torch.randint(len(cells), (600,), generator=generator)]
    rules = StructureRules(*counts.unbind(1))
    columns = []
    while not rules.finished.all():
        mask, live = rules.mask(), ~rules.finished
        assert torch.equal(mask.any(1), live)
        p = torch.where(live[:, None], mask.float(), 1.0)
        token = torch.where(live, torch.multinomial(p, 1, generator=generator)[:, 0], -1)
        columns.append(token)
        rules.advance(token.clamp(min=0))
    structure = torch.stack(columns, 1)
    n_steps = Steps.of(structure).valid.sum(1).tolist()
    for row, n, asked in zip(structure.numpy(), n_steps, counts.tolist(), strict=True):
        nothing = np.zeros(n, dtype=int)
        group = decode(Tokens(row[row >= 0], nothing, nothing))
        assert group_fault(group) is None
        assert canonical(group) == group
        assert [group.n_agents, group.n_events, group.n_nodes] == asked


def test_no_authored_structure_is_refused():
    scenarios = load_corpus()[::8]
    graphs = [g for i, s in enumerate(scenarios) for g in weave(rehearse(s, np.random.default_rng(i)).records).groups()]
    batch = GroupBatch.of([encode(g) for g in graphs])
    counts = torch.tensor([[g.n_agents, g.n_events, g.n_nodes] for g in graphs])
    rules = StructureRules(*counts.unbind(1))
    for token in batch.structure.unbind(1):
        live = token >= 0
        assert torch.equal(rules.finished, ~live)
        allowed = rules.mask().gather(1, token.clamp(min=0)[:, None])[:, 0]
        assert allowed[live].all()
        rules.advance(token.clamp(min=0))
    assert rules.finished.all()
    assert (rules.nodes == 0).all()
