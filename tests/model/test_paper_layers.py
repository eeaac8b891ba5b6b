"""The layers of the paper model against the equations, and against PyTorch Geometric."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
import torch
from torch import nn

from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.model.paper.decoders import FeatureDecoder, StructureDecoder
from genc.model.paper.encoder import Encoder, NodeFeatures, sinusoids
from genc.model.paper.gine import GINE
from genc.model.paper.graphs import SHARE, Batch, Structures
from genc.model.paper.laplacian import laplacian_encoding
from genc.model.paper.vgae import GAMMA, features_loss, structure_loss
from genc.scenario.corpus import load_theme
from genc.scenario.rehearse import rehearse


@pytest.fixture(scope="module")
def groups() -> list[CrowdGraph]:
    rng = np.random.default_rng(0)
    return [g for s in load_theme("museum")[:2] for g in weave(rehearse(s, rng).records).groups()]


@pytest.fixture(scope="module")
def batch(groups: list[CrowdGraph]) -> Batch:
    return Batch.packed([Batch.of(g, np.arange(g.n_nodes)) for g in groups])


def test_gine_is_that_of_pytorch_geometric(batch: Batch) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from torch_geometric.nn import GINEConv
    torch.manual_seed(0)
    ours = GINE(16)
    with torch.no_grad():
        ours.epsilon.fill_(0.3)
    theirs = GINEConv(nn.Sequential(*ours.mlp), eps=0.3)
    structures = batch.structures
    h = torch.randn(len(structures.position), 16)
    edges = torch.stack([structures.source, structures.target])
    expected = theirs(h, edges, ours.edge(structures.kind))
    torch.testing.assert_close(ours(h, structures), expected, atol=1e-5, rtol=1e-5)
    assert set(structures.kind.tolist()) == {0, 1}


def test_packing_keeps_graphs_apart(groups: list[CrowdGraph], batch: Batch) -> None:
    torch.manual_seed(0)
    encoder = Encoder(16, 4, 3, 0.0).eval()
    condition = torch.randn(len(groups), 4)
    together = encoder(batch, condition)
    for i, group in enumerate(groups):
        alone = encoder(Batch.of(group, np.arange(group.n_nodes)), condition[i : i + 1])
        torch.testing.assert_close(together.mean[i : i + 1], alone.mean, atol=1e-5, rtol=1e-4)
        torch.testing.assert_close(together.stddev[i : i + 1], alone.stddev, atol=1e-5, rtol=1e-4)


def test_node_features_have_49_dimensions_of_which_each_counts(batch: Batch) -> None:
    torch.manual_seed(0)
    features = NodeFeatures()(batch)
    assert features.shape == (len(batch.nodes.agent), 49)
    assert (features.std(0) > 0).all()
    assert batch.nodes.time.min() == 0
    assert batch.nodes.time.max() == 1


def test_sinusoids_are_those_of_the_transformer() -> None:
    expected = [np.sin(7), np.cos(7), np.sin(0.07), np.cos(0.07)]
    assert sinusoids(torch.tensor([0, 7]))[1].tolist() == pytest.approx(expected, abs=1e-6)


def test_laplacian_vectors_are_eigenvectors_in_ascending_order(groups: list[CrowdGraph]) -> None:
    import networkx as nx

    for group in groups:
        n = group.n_nodes
        vectors = laplacian_encoding(group.adjacency != 0)
        assert vectors.shape == (n, 4)
        if n < 6:
            assert not vectors[:, n - 1 :].any()
            continue
        laplacian = nx.normalized_laplacian_matrix(nx.from_numpy_array(np.abs(group.adjacency))).toarray()
        values = np.array([v @ laplacian @ v for v in vectors.T])
        # the diagonal that breaks ties moves eigenvalues by 1e-3 at most
        assert values == pytest.approx(np.linalg.eigvalsh(laplacian)[1:5], abs=2e-3)
        assert vectors.T @ vectors == pytest.approx(np.eye(4), abs=1e-5)


def test_the_adjacency_is_u_plus_its_transpose() -> None:
    torch.manual_seed(0)
    decoder = StructureDecoder(3, 4, 16)
    z, condition = torch.randn(5, 3), torch.randn(5, 4)
    matrix = decoder(z, condition)
    assert matrix.shape == (5, 100, 100)
    assert torch.equal(matrix, matrix.transpose(1, 2))
    assert not matrix.diagonal(dim1=1, dim2=2).any()
    upper = np.triu_indices(100, 1)
    expected = torch.tanh(decoder.mlp(torch.cat([z, condition], 1)))
    assert torch.equal(matrix[:, upper[0], upper[1]], expected)


def test_members_of_a_moment_get_one_action_and_one_place(batch: Batch, groups: list[CrowdGraph]) -> None:
    torch.manual_seed(0)
    decoder = FeatureDecoder(3, 4, 16)
    action, category = decoder(torch.randn(len(groups), 3), torch.randn(len(groups), 4), batch.structures)
    assert action.shape == (len(batch.nodes.agent), 13)
    assert category.shape == (len(batch.nodes.agent), 8)
    shares = batch.structures.kind == SHARE
    source, target = batch.structures.source[shares], batch.structures.target[shares]
    assert len(source) > 0
    assert torch.equal(action[source], action[target])
    assert torch.equal(category[source], category[target])
    assert action.unique(dim=0).shape[0] > len(groups)


def test_moments_are_numbered_over_the_batch_and_shared_out_within_each_graph(
    batch: Batch, groups: list[CrowdGraph]
) -> None:
    structures: Structures = batch.structures
    assert torch.equal(structures.moment.unique(), torch.arange(int(structures.moment.max()) + 1))
    n_moments = [len({(e, t) for e, t in zip(g.event.tolist(), g.turn.tolist(), strict=True)}) for g in groups]
    assert int(structures.moment.max()) + 1 == sum(n_moments)
    assert structures.moment_share.max() < 1


def test_structure_loss_is_smooth_l1_over_all_pairs_of_the_graph(batch: Batch, groups: list[CrowdGraph]) -> None:
    matrix = torch.rand(len(groups), 100, 100) * 4 - 2
    for i, group in enumerate(groups):
        n = group.n_nodes
        d = np.abs(matrix[i, :n, :n].numpy() - group.adjacency)
        expected = np.where(d < 1, 0.5 * d**2, d - 0.5).sum()
        assert structure_loss(batch, matrix)[i].item() == pytest.approx(expected, rel=1e-4)


def test_features_loss_is_weighted_cross_entropy_over_nodes(batch: Batch, groups: list[CrowdGraph]) -> None:
    n = len(batch.nodes.agent)
    action, category = torch.randn(n, 13), torch.randn(n, 8)
    start = 0
    for i, group in enumerate(groups):
        rows = slice(start, start + group.n_nodes)
        start += group.n_nodes
        of_action = -action[rows].log_softmax(1)[range(group.n_nodes), group.action.tolist()].sum()
        of_category = -category[rows].log_softmax(1)[range(group.n_nodes), group.category.tolist()].sum()
        expected = GAMMA * of_action + of_category
        assert GAMMA == 1.5
        assert features_loss(batch, action, category)[i].item() == pytest.approx(expected.item(), rel=1e-4)
