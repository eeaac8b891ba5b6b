"""Sampling: exact counts, one result for one seed, and the same distribution as in training."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import tiny
import torch

from genc.graph.codec import group_fault
from genc.graph.describe import action_frequencies
from genc.model import feature_decoder, structure_decoder
from genc.model.condition import N_ACTIONS, Conditions
from genc.model.rules import StructureRules
from genc.model.sampling import Sampling, draw
from genc.model.structure_decoder import Trace
from genc.model.tensors import GroupBatch, Steps
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, Action

SHARES = tuple(1.0 if a is Action.QUEUE else 0.0 for a in ACTIONS)
BRIEFS = [
    Brief("people queue"),
    Brief("two friends", n_agents=2),
    Brief("a long row", n_nodes=37),
    Brief("a busy family", n_agents=5, n_events=9, n_nodes=30),
    Brief("a crowd", n_agents=15, n_events=30, n_nodes=100),
    Brief("one thing", n_agents=3, n_events=1, n_nodes=12, action_frequencies=SHARES),
    Brief("somebody", n_events=4, action_frequencies=SHARES),
]


@pytest.mark.parametrize("guidance", [1.0, 2.0])
def test_requested_counts_are_met_exactly_and_every_group_is_valid(guidance):
    groups = tiny.generator(guidance=guidance).sample(BRIEFS * 12, np.random.default_rng(0))
    for brief, group in zip(BRIEFS * 12, groups, strict=True):
        assert group_fault(group) is None
        for name in ("n_agents", "n_events", "n_nodes"):
            assert getattr(brief, name) in (None, getattr(group, name))


def test_the_same_seed_gives_the_same_groups_and_another_seed_others():
    def drawn(seed: int) -> list[object]:
        return tiny.generator().sample(BRIEFS * 3, np.random.default_rng(seed))

    assert drawn(1) == drawn(1)
    assert drawn(1) != drawn(2)


def test_the_number_of_threads_does_not_matter():
    briefs = [Brief(f"group {i}") for i in range(600)]
    before = torch.get_num_threads()
    try:
        torch.set_num_threads(1)
        alone = tiny.generator().sample(briefs, np.random.default_rng(0))
        torch.set_num_threads(3)
        assert tiny.generator().sample(briefs, np.random.default_rng(0)) == alone
    finally:
        torch.set_num_threads(before)


def test_no_briefs_give_no_groups():
    assert tiny.generator().sample([], np.random.default_rng(0)) == []


def test_top_p_and_temperature_narrow_the_choice():
    logits = torch.log(torch.tensor([[0.6, 0.3, 0.1]])).repeat(2000, 1)
    chance = Sampling(torch.Generator().manual_seed(0))
    assert set(draw(logits, chance).tolist()) == {0, 1, 2}
    assert set(draw(logits, replace(chance, top_p=0.7)).tolist()) == {0, 1}
    assert set(draw(logits, replace(chance, temperature=0.05)).tolist()) == {0}


def _told(monkeypatch: pytest.MonkeyPatch, module: object) -> list[torch.Tensor]:
    """Lets every draw of a decoder take note of log p of what it draws."""
    told = []

    def noting(logits, sampling):
        drawn = draw(logits, sampling)
        told.append(torch.log_softmax(logits, 1).gather(1, drawn[:, None])[:, 0])
        return drawn

    monkeypatch.setattr(module, "draw", noting)
    return told


def test_structures_are_drawn_from_the_distribution_that_is_trained(monkeypatch):
    model = tiny.generator().model
    counts = torch.tensor([[3, 4, 17]] * 4)
    context = torch.randn(1, 12).expand(4, -1)
    told = _told(monkeypatch, structure_decoder)
    rows = [0, 1, 2, 3]
    with torch.inference_mode():
        rules = StructureRules(*counts.unbind(1))
        structure = model.structure.sample(rules, [context], Sampling(torch.Generator().manual_seed(3)))
        expected = model.structure.log_prob(structure, Trace.of(structure, counts), context)
    drawn, length = torch.zeros(4), (structure >= 0).sum(1)
    for t, log_p in enumerate(told):
        alive = [i for i in rows if length[i] > t]
        drawn[alive] += log_p
    torch.testing.assert_close(drawn, expected, rtol=1e-4, atol=1e-4)


def test_features_are_drawn_from_the_distribution_that_is_trained(monkeypatch):
    model = tiny.generator().model
    group = tiny.generator().sample([Brief("x", n_agents=4, n_events=6, n_nodes=25)], np.random.default_rng(1))[0]
    from genc.graph.codec import encode

    structure = torch.from_numpy(encode(group).structure)[None]
    wanted = torch.zeros(1, N_ACTIONS)
    wanted[0, 3] = 25
    context = torch.randn(1, 12)
    told = _told(monkeypatch, feature_decoder)
    with torch.inference_mode():
        steps = Steps.of(structure)
        action, category = model.features.sample(steps, [context], wanted, Sampling(torch.Generator().manual_seed(0)))
        expected = model.features.log_prob(GroupBatch(structure, action, category), steps, context, wanted)
    torch.testing.assert_close(torch.stack(told).sum(0), expected, rtol=1e-4, atol=1e-4)


def test_open_counts_follow_the_table_given_the_others():
    model = tiny.generator().model
    given = Conditions(torch.zeros(400, 64), torch.tensor([[0, 0, 12]]).expand(400, -1), torch.zeros(400, N_ACTIONS))
    with torch.inference_mode():
        counts = model.counts.sample(given, Sampling(torch.Generator().manual_seed(0)))
        log_p = model.counts.log_prob(given, counts)
    assert (counts[:, 2] == 12).all()
    assert torch.isfinite(log_p).all()
    assert len(counts.unique(dim=0)) > 20


def test_frequencies_of_a_group_are_shares_of_its_nodes():
    group = tiny.generator().sample([BRIEFS[3]], np.random.default_rng(0))[0]
    shares = action_frequencies(group)
    assert sum(shares) == pytest.approx(1)
    assert shares[int(group.action[0])] == pytest.approx(float((group.action == group.action[0]).mean()))
