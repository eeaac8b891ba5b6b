"""Crowds of any size out of a small one, quickly: copies of its people, each shifted a little in place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genc.world.world import World


def tiled(world: World, n_agents: int, rng: np.random.Generator) -> World:
    """A world of `n_agents` who all do what somebody of `world` does, up to a metre beside."""
    plan, motion = world.plan, world.motion
    of, n_copies = _sources(len(plan.people), n_agents)
    shift = np.repeat(range(n_copies), len(plan.people))[:n_agents]
    n_groups = len(plan.captions)
    occasions = 1 + max(a.occasion for person in plan.people for a in person.activities)

    def copied(agent: int) -> object:
        copy, person = int(shift[agent]), plan.people[of[agent]]
        own = tuple(
            replace(
                activity,
                occasion=activity.occasion + copy * occasions,
                partners=tuple(
                    p + copy * len(plan.people) for p in activity.partners if p + copy * len(plan.people) < n_agents
                ),
            )
            for activity in person.activities
        )
        return replace(person, group=person.group + copy * n_groups, activities=own)

    done: dict[int, list] = {}
    for row in motion.executed:
        done.setdefault(row.agent, []).append(row)
    beside_m = rng.uniform(-1, 1, (n_agents, 2)) * (shift > 0)[:, None]
    return World(
        plan=replace(plan, people=tuple(map(copied, range(n_agents))), captions=plan.captions * n_copies),
        motion=replace(
            motion,
            positions_m=(motion.positions_m[:, of] + beside_m).astype(np.float32),
            headings_rad=motion.headings_rad[:, of],
            present=motion.present[:, of],
            executed=tuple(
                replace(row, agent=agent) for agent in range(n_agents) for row in done.get(int(of[agent]), ())
            ),
        ),
        provenance=world.provenance,
    )


def _sources(n_there: int, n_wanted: int) -> tuple[np.ndarray, int]:
    """For each new agent whom it copies; and how many rounds that makes."""
    return np.arange(n_wanted) % n_there, -(-n_wanted // n_there)
