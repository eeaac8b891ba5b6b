"""Laplacian positional encodings (Gen-C, Node Features)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

N_VECTORS = 4
TIE_BREAK = 1e-3


def laplacian_encoding(linked: NDArray[np.bool_]) -> NDArray[np.float32]:
    """The top-4 eigenvectors of the normalised Laplacian, one row for each node, `[n, 4]`.

    The paper does not say: which are the top ones (here the smoothest, those of the smallest eigenvalues after the
    first, as is usual: Dwivedi et al. 2020), what a graph of fewer than five nodes gets (zeros in place of what it
    lacks), and how signs and shared eigenvalues are settled. Eigenvectors of one eigenvalue can be rotated at will, and
    graphs of several parts have many that are 0; a diagonal that grows by 1e-3 along the order of nodes singles out one
    basis, and each vector's largest entry is made positive.

    Args:
        linked: symmetric, True where two nodes share an edge of any kind, `[n, n]`.
    """
    n = len(linked)
    degree = linked.sum(1)
    scale = 1 / np.sqrt(np.maximum(degree, 1))
    laplacian = np.diag((degree > 0).astype(np.float64)) - linked * np.outer(scale, scale)
    laplacian += np.diag(TIE_BREAK * np.arange(n) / n)
    vectors = np.linalg.eigh(laplacian).eigenvectors[:, 1 : 1 + N_VECTORS]
    largest = np.abs(vectors).argmax(0)
    vectors = vectors * np.sign(vectors[largest, np.arange(vectors.shape[1])])
    return np.pad(vectors, ((0, 0), (0, N_VECTORS - vectors.shape[1]))).astype(np.float32)
