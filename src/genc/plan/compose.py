"""Groups until the crowd is complete (Gen-C, Crowd Scenario Generation)."""

from __future__ import annotations

from collections.abc import Callable

from genc.graph.crowd_graph import CrowdGraph

_MEAN_SIZE = 2.1


def compose(sample: Callable[[int, int | None], list[CrowdGraph]], n_agents: int) -> list[CrowdGraph]:
    """Groups with exactly `n_agents` people in all.

    Groups come as they are drawn until the next would be too large; one last group of just the missing size
    completes the crowd. `sample(n_groups, n_agents)` draws groups, of a given size if one is named.
    """
    groups: list[CrowdGraph] = []
    missing = n_agents
    while missing > 0:
        for group in sample(round(missing / _MEAN_SIZE) + 1, None):
            if group.n_agents > missing:
                groups.extend(sample(1, missing) if missing else [])
                return groups
            groups.append(group)
            missing -= group.n_agents
    return groups
