from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.parameters import LayerParameters


@st.composite
def coregionalisations(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    q, d, rank = draw(st.integers(1, 3)), draw(st.integers(1, 4)), draw(st.integers(0, 3))
    shapes = ((q,), (q, d, rank), (q, d))
    return LayerParameters(*(rng.standard_normal(shape) for shape in shapes))


@given(coregionalisations())
def test_matrices_follow_the_formula(b):
    for matrix, weights, roots in zip(b.matrices, b.weights, b.kappa_roots, strict=True):
        np.testing.assert_allclose(matrix, weights @ weights.T + np.diag(roots**2), atol=1e-14)
        assert np.linalg.eigvalsh(matrix).min() > -1e-12


@given(coregionalisations())
def test_variances_are_the_diagonals(b):
    np.testing.assert_allclose(b.variances, b.matrices.sum(axis=0).diagonal(), rtol=1e-12)


@given(coregionalisations())
def test_signs_of_the_free_parameters_do_not_matter(b):
    flipped = replace(b, weights=-b.weights, kappa_roots=-b.kappa_roots)
    np.testing.assert_array_equal(b.matrices, flipped.matrices)


@given(coregionalisations(), st.integers(0, 2**32 - 1))
def test_pull_back_is_the_transpose_of_the_derivative(b, seed):
    rng = np.random.default_rng(seed)
    adjoint = rng.standard_normal(b.matrices.shape)
    weights, roots = rng.standard_normal(b.weights.shape), rng.standard_normal(b.kappa_roots.shape)
    by_scale = rng.standard_normal(len(b.weights))
    gradient, step = b.pull_back(by_scale, adjoint), 1e-6
    up, down = (
        replace(b, weights=b.weights + s * weights, kappa_roots=b.kappa_roots + s * roots).matrices
        for s in (step, -step)
    )
    forward = np.vdot(adjoint, (up - down) / (2 * step))
    backward = np.vdot(gradient.weights, weights) + np.vdot(gradient.kappa_roots, roots)
    np.testing.assert_allclose(forward, backward, rtol=1e-6, atol=1e-6)
    np.testing.assert_array_equal(gradient.log_lengthscales, by_scale)
