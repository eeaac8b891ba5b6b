"""Graphs as the paper's layers read them: nodes of many graphs side by side, edges as a list.

B graphs, N nodes in all, E directed edges in all (each edge of a graph both ways).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components
from torch import Tensor

from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.model.paper.laplacian import laplacian_encoding

SEQUENCE, SHARE = 0, 1
"""Kinds of edges."""


@dataclass(frozen=True, eq=False)
class Structures:
    """What edges say of each node: all that the feature decoder is told of a structure.

    Attributes:
        n_nodes: `[B]`.
        position: `[N]` the row of each node in its own graph's matrix.
        source, target, kind: `[E]` node numbers in 0..N-1, and `SEQUENCE` or `SHARE`.
        moment: `[N]` the connected part of share edges that each node is in; numbered over the whole batch.
        moment_share: `[N]` the same, as a share of the moments of its graph: the normalised group identifier.
        laplacian, share_laplacian: `[N, 4]` encodings of the full graph and of its share edges alone.
    """

    n_nodes: Tensor
    position: Tensor
    source: Tensor
    target: Tensor
    kind: Tensor
    moment: Tensor
    moment_share: Tensor
    laplacian: Tensor
    share_laplacian: Tensor

    @property
    def graph(self) -> Tensor:
        """`[N]` the graph of each node."""
        return torch.repeat_interleave(self.n_nodes)

    @staticmethod
    def of(adjacency: NDArray[np.int8]) -> Structures:
        """One graph, from its signed adjacency `[n, n]`."""
        source, target = np.nonzero(adjacency)
        shares = adjacency < 0
        n_moments, moment = connected_components(shares, directed=False)
        n = len(adjacency)
        return Structures(
            torch.tensor([n]),
            torch.arange(n),
            torch.from_numpy(source),
            torch.from_numpy(target),
            torch.from_numpy(np.where(adjacency[source, target] > 0, SEQUENCE, SHARE)),
            torch.from_numpy(moment.astype(np.int64)),
            torch.from_numpy((moment / n_moments).astype(np.float32)),
            torch.from_numpy(laplacian_encoding(adjacency != 0)),
            torch.from_numpy(laplacian_encoding(shares)),
        )

    @staticmethod
    def packed(graphs: Sequence[Structures]) -> Structures:
        """The same graphs as one batch."""
        n_nodes = [int(g.n_nodes) for g in graphs]
        n_moments = [int(g.moment.max()) + 1 for g in graphs]
        first_node = np.cumsum([0, *n_nodes[:-1]]).tolist()
        first_moment = np.cumsum([0, *n_moments[:-1]]).tolist()
        columns = {f.name: [getattr(g, f.name) for g in graphs] for f in fields(Structures)}
        for name, shifts in (("source", first_node), ("target", first_node), ("moment", first_moment)):
            columns[name] = [tensor + shift for tensor, shift in zip(columns[name], shifts, strict=True)]
        return Structures(**{name: torch.cat(tensors) for name, tensors in columns.items()})


@dataclass(frozen=True, eq=False)
class Nodes:
    """What is said of each node besides its edges.

    Attributes:
        agent, action, category: `[N]` indices.
        time: `[N]` the place in the agent's own timeline, 0 first, 1 last.
    """

    agent: Tensor
    action: Tensor
    category: Tensor
    time: Tensor

    @staticmethod
    def of(graph: CrowdGraph, order: Ints) -> Nodes:
        """The nodes of one graph, in this order `[n]`."""
        last = np.zeros(graph.n_agents, dtype=np.int64)
        np.maximum.at(last, graph.agent, graph.step)
        time = graph.step / np.maximum(last[graph.agent], 1)
        columns = (graph.agent, graph.action, graph.category, time.astype(np.float32))
        return Nodes(*(torch.from_numpy(column[order]) for column in columns))

    @staticmethod
    def packed(graphs: Sequence[Nodes]) -> Nodes:
        """The same as one batch."""
        return Nodes(*(torch.cat([getattr(g, f.name) for g in graphs]) for f in fields(Nodes)))


_Columns = TypeVar("_Columns", Nodes, Structures)


@dataclass(frozen=True, eq=False)
class Batch:
    """Whole graphs, their structure as matrices too.

    Attributes:
        adjacency: `[B, n, n]` signed, zero beyond each graph's own nodes; n is the largest graph's.
    """

    nodes: Nodes
    structures: Structures
    adjacency: Tensor

    def to(self, device: torch.device) -> Batch:
        """The same batch on another device."""
        return Batch(_moved(self.nodes, device), _moved(self.structures, device), self.adjacency.to(device))

    @staticmethod
    def of(graph: CrowdGraph, order: Ints) -> Batch:
        """One graph, its nodes in this order `[n]` (0..n-1 for the canonical one)."""
        adjacency = graph.adjacency[np.ix_(order, order)]
        matrix = torch.from_numpy(adjacency.astype(np.float32))[None]
        return Batch(Nodes.of(graph, order), Structures.of(adjacency), matrix)

    @staticmethod
    def packed(graphs: Sequence[Batch]) -> Batch:
        """The same as one batch."""
        most = max(g.adjacency.shape[1] for g in graphs)
        adjacency = torch.zeros(len(graphs), most, most)
        for row, g in zip(adjacency, graphs, strict=True):
            n = g.adjacency.shape[1]
            row[:n, :n] = g.adjacency[0]
        nodes, structures = Nodes.packed([g.nodes for g in graphs]), Structures.packed([g.structures for g in graphs])
        return Batch(nodes, structures, adjacency)


def _moved(columns: _Columns, device: torch.device) -> _Columns:
    return type(columns)(*(getattr(columns, f.name).to(device) for f in fields(columns)))
