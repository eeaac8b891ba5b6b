"""Distances between two sets of feature vectors, such as posterior means (Gen-C, Latent Space Analysis, Table 4).

Both belong to a space as much as to a generator. A Fréchet distance scales with the square of the latent scale: halve
all latents and it is a quarter, so figures of two encoders, and the paper's beside ours, do not compare. And a model
judged in its own space can be made to look good: an encoder that maps everything to the prior puts both sets at
distance 0. So the encoder must be fixed and trained on training data alone, the floor (authored groups against
authored groups, as many) must stand beside the figure, and `random_gin` gives a space that is nobody's own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr
from scipy.spatial.distance import pdist

Floats = NDArray[np.float64]

_BLOCK_ROWS = 512
_MEDIAN_ROWS = 1000


def frechet_distance(x: Floats, y: Floats) -> float:
    """|mean x - mean y|^2 + Tr(Sx + Sy - 2 (Sx Sy)^(1/2)) of features `[n, d]` and `[m, d]`; 0 at best.

    In squared units of the features. It rests on means and covariances alone, and is biased upwards by some
    d^2 / n: compare figures from equally many samples only. Covariances divide by n - 1. (Gen-C, Latent Space
    Analysis, FID; Heusel et al. 2017.)

    Raises:
        ValueError: if either set has fewer than two rows.
    """
    _check(x, y)
    # With S = R^T R, the eigenvalues of Sx Sy are the squared singular values of Rx Ry^T. No root of a matrix is
    # taken, so nothing turns complex, and a singular covariance (n <= d) is as good as any.
    root_x, root_y = _covariance_root(x), _covariance_root(y)
    overlap = np.linalg.svd(root_x @ root_y.T, compute_uv=False).sum()
    shift = np.square(x.mean(0) - y.mean(0)).sum()
    return max(0.0, float(shift + np.square(root_x).sum() + np.square(root_y).sum() - 2 * overlap))


def mmd_squared(x: Floats, y: Floats, gamma: float | None = None) -> float:
    """The unbiased estimate of MMD^2 with kernel exp(-gamma |x - y|^2); 0 is best, and it may fall below.

    Unbiased (Gretton et al. 2012, eq. 3): no point is paired with itself, so two samples of one distribution give 0
    on average at every size, where the usual biased estimate gives some 2 / n.

    The paper defines MMD^2 and heads its columns "MMD" (Gen-C, Latent Space Analysis, Table 4); that these hold what
    is defined, MMD^2, also fits their size. Between Gaussians of unit variance in 32 dimensions, as far apart as the
    FID beside them says if only their means differ (1.95 and 9.29), MMD^2 is 0.02 and 0.10, its root 0.15 and 0.31;
    the table says 0.03 to 0.11. `mmd` gives the other reading.

    Args:
        x: the real features `[n, d]`.
        y: the generated features `[m, d]`.
        gamma: by default `bandwidth(x)`.

    Raises:
        ValueError: if either set has fewer than two rows.
    """
    _check(x, y)
    gamma = bandwidth(x) if gamma is None else gamma
    within = sum((_kernel_sum(z, z, gamma) - len(z)) / (len(z) * (len(z) - 1)) for z in (x, y))
    return float(within - 2 * _kernel_sum(x, y, gamma) / (len(x) * len(y)))


def mmd(x: Floats, y: Floats, gamma: float | None = None) -> float:
    """The root of `mmd_squared`, 0 where that is negative: no longer unbiased, but in the units of a distance."""
    return float(max(0.0, mmd_squared(x, y, gamma)) ** 0.5)


def bandwidth(x: Floats) -> float:
    """The gamma of the kernel: 1 over the median squared distance between distinct points of the real set.

    Of the real set alone: were the generated set to widen the kernel, a worse generator would be measured with a
    duller instrument. (The paper does not say its gamma.) Of a large set, about 1,000 rows evenly spread over it.
    """
    distances = pdist(x[:: -(-len(x) // _MEDIAN_ROWS)], "sqeuclidean")
    distances = distances[distances > 0]
    return float(1 / np.median(distances)) if len(distances) else 1.0


def _covariance_root(x: Floats) -> Floats:
    """R with R^T R = the covariance."""
    root: Floats = qr((x - x.mean(0)) / np.sqrt(len(x) - 1), mode="r")[0]
    return root


def _kernel_sum(x: Floats, y: Floats, gamma: float) -> float:
    """The kernel summed over all pairs, some rows at a time: 5,000 x 5,000 pairs at once would be 200 MB."""
    x, y = x - x.mean(0), y - x.mean(0)  # far from 0 the differences of squares would lose their digits
    y_squares = np.square(y).sum(1)
    total = 0.0
    for start in range(0, len(x), _BLOCK_ROWS):
        rows = x[start : start + _BLOCK_ROWS]
        squares = np.square(rows).sum(1)[:, None] + y_squares - 2 * rows @ y.T
        total += float(np.exp(-gamma * np.maximum(squares, 0.0)).sum())
    return total


def _check(x: Floats, y: Floats) -> None:
    if min(len(x), len(y)) < 2:
        raise ValueError(f"sets of {len(x)} and {len(y)} rows; a distance between distributions needs two of each")
