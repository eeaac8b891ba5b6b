from __future__ import annotations

import numpy as np
import torch

from genc.graph.codec import Tokens, encode
from genc.graph.weave import weave
from genc.model.tensors import GroupBatch, Steps
from genc.scenario.corpus import load_corpus
from genc.scenario.rehearse import rehearse

TOKENS = [encode(group) for group in weave(rehearse(load_corpus()[3], np.random.default_rng(0)).records).groups()]


def _members(tokens: Tokens) -> list[tuple[int, int, set[int]]]:
    """Event, turn and people of each step, read token by token."""
    steps, inside, event = [], set(), 0
    for token in tokens.structure.tolist():
        if token < 15:
            inside.add(token)
        else:
            steps += [(event, turn, set(inside)) for turn in range(token - 14)]
            inside, event = set(), event + 1
    return steps


def _relation(steps: list[tuple[int, int, set[int]]], s: int, r: int) -> int:
    """What `Steps.relations` says it is, in plain words."""
    if s == r:
        return 12
    (event_s, turn_s, people_s), (event_r, turn_r, people_r) = steps[s], steps[r]
    first, last = min(s, r), max(s, r)
    between = [people for _, _, people in steps[first + 1 : last]]
    direct = any(all(a not in people for people in between) for a in people_s & people_r)
    if event_s == event_r:
        kind = 0 if abs(turn_s - turn_r) == 1 else 1
    elif direct:
        kind = 2 if people_s == people_r else 3
    else:
        kind = 4 if people_s & people_r else 5
    return kind if r < s else kind + 6


def test_steps_say_who_takes_part():
    batch = Steps.of(GroupBatch.of(TOKENS).structure)
    for i, tokens in enumerate(TOKENS):
        steps = _members(tokens)
        assert batch.valid[i].sum() == len(steps) == len(tokens.action)
        for t, (event, turn, people) in enumerate(steps):
            assert set(batch.members[i, t].nonzero()[:, 0].tolist()) == people
            assert (batch.event[i, t], batch.turn[i, t]) == (event, turn)
            assert batch.steps_left[i, t] == len(steps) - 1 - t
            assert batch.turns_left[i, t] == sum(e == event for e, _, _ in steps) - 1 - turn


def test_relations_agree_with_their_definition():
    relations = Steps.of(GroupBatch.of(TOKENS).structure).relations()
    for i, tokens in enumerate(TOKENS):
        steps = _members(tokens)
        expected = [[_relation(steps, s, r) for r in range(len(steps))] for s in range(len(steps))]
        assert relations[i, : len(steps), : len(steps)].tolist() == expected


def test_a_batch_gives_its_tokens_back():
    for ours, theirs in zip(GroupBatch.of(TOKENS).tokens(), TOKENS, strict=True):
        assert all(np.array_equal(a, b) for a, b in zip(vars(ours).values(), vars(theirs).values(), strict=True))
    assert torch.is_tensor(GroupBatch.of(TOKENS).action)
