"""`SignedGraph`: a graph as a decoder of matrices gives it, which need not be a crowd scenario graph."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from genc.graph.crowd_graph import Ints


class Labelled(Protocol):
    """What the measures look at: a signed adjacency and labelled nodes. `CrowdGraph` and `SignedGraph` are such."""

    @property
    def adjacency(self) -> NDArray[np.int8]:
        """`[n, n]`, symmetric, zero diagonal: 0 no edge, +1 sequence, -1 share."""
        ...

    @property
    def action(self) -> Ints:
        """Vocabulary indices `[n]`."""
        ...

    @property
    def category(self) -> Ints:
        """Vocabulary indices `[n]`."""
        ...


@dataclass(frozen=True, eq=False)
class SignedGraph:
    """Any signed adjacency with labelled nodes (Gen-C, Data Preprocessing); nodes in the order they were decoded in.

    A sequence edge leads from the node of the lower index to that of the higher. Nothing makes sequence edges into
    chains or share edges into cliques: `genc.graph.repair` does.

    Attributes:
        adjacency: int8 `[n, n]`, symmetric, zero diagonal: 0 no edge, +1 sequence, -1 share.
        action, category: vocabulary indices `[n]`.
    """

    adjacency: NDArray[np.int8]
    action: Ints
    category: Ints

    @property
    def n_nodes(self) -> int:
        """Nodes."""
        return len(self.action)
