"""Signs of singular vectors and eigenvectors that do not depend on rounding."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["orient_vectors"]


_AS_LARGE = 1.0 - 1e-8


def orient_vectors(vectors: Array) -> Array:
    """Return vectors (n, k), columns, with signs that make one entry of each positive.

    It is the first one that is as large as the largest, up to a factor of 1 - 10⁻⁸: where two are
    equally large, rounding would choose between them, as in
    `sklearn.utils.extmath.svd_flip`.
    """
    sizes = np.abs(vectors)
    first = (sizes >= _AS_LARGE * sizes.max(axis=0)).argmax(axis=0)
    return np.asarray(vectors * np.where(vectors[first, np.arange(len(first))] < 0, -1.0, 1.0))
