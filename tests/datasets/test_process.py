"""The toy process: its draws have the moments that it states."""

import numpy as np
import pytest

from mocapbench.datasets import Layer, ToyProcess
from mocapbench.datasets.process import uniform_weights

TIMES = np.linspace(0.0, 2.0 * np.pi, 6)
NORMAL, UNIFORM = np.random.Generator.standard_normal, np.random.Generator.random


@pytest.fixture
def process():
    return ToyProcess.random(np.random.default_rng(1), n_outputs=2, noise=0.1)


def stacked(children):
    """(n, D N), outputs slowest."""
    return np.stack([child.values.T.ravel() for child in children])


@pytest.mark.parametrize("weights", [NORMAL, UNIFORM])
def test_layers_have_the_stated_mean_variance(weights):
    rng = np.random.default_rng(2)
    for n_outputs in (1, 3, 6):
        process = ToyProcess.random(rng, n_outputs=n_outputs, noise=0.01, weights=weights)
        n = n_outputs * len(TIMES)
        assert np.trace(process.parent.covariance(TIMES)) / n == pytest.approx(1.0)
        assert np.trace(process.child.covariance(TIMES)) / n == pytest.approx(0.25)


def test_uniform_weights_correlate_outputs_positively_and_more():
    rng = np.random.default_rng(2)
    correlations = {}
    for weights in (NORMAL, UNIFORM):
        layers = [Layer.random(rng, 3, 3, 1.0, weights) for _ in range(50)]
        total = np.stack([layer.coregionalisation.sum(axis=0) for layer in layers])
        scale = np.sqrt(np.diagonal(total, axis1=1, axis2=2))
        correlations[weights] = (total / scale[:, :, None] / scale[:, None, :])[:, 0, 1]
    assert (correlations[UNIFORM] > 0.0).all()
    assert (correlations[NORMAL] < 0.0).any()
    assert np.abs(correlations[UNIFORM]).mean() > np.abs(correlations[NORMAL]).mean()


def test_a_layer_is_a_sum_of_kronecker_products(process):
    lags = np.subtract.outer(TIMES, TIMES)
    expected = sum(
        np.kron(matrix, np.exp(-0.5 * (lags / lengthscale) ** 2))
        for matrix, lengthscale in zip(
            process.parent.coregionalisation, process.parent.lengthscales, strict=True
        )
    )
    np.testing.assert_allclose(process.parent.covariance(TIMES), expected)


def test_covariances_are_symmetric_and_positive(process):
    covariance = process.covariance(TIMES)
    np.testing.assert_array_equal(covariance, covariance.T)
    assert np.linalg.eigvalsh(covariance).min() >= 0.1 - 1e-9


def test_a_child_has_the_stated_covariance(process):
    rng = np.random.default_rng(3)
    n = 4000
    children = stacked([process.draw(rng, TIMES, 1)[0] for _ in range(n)])
    covariance = process.covariance(TIMES)
    # Whitened draws have unit covariance, whose estimate errs by 1/√n an entry, √2/√n on the
    # diagonal; five such errors are allowed for.
    white = np.linalg.solve(np.linalg.cholesky(covariance), children.T)
    np.testing.assert_allclose(white.mean(axis=1), 0.0, atol=5 / np.sqrt(n))
    np.testing.assert_allclose(white @ white.T / n, np.eye(12), atol=5 * np.sqrt(2 / n))


def test_siblings_share_their_parent(process):
    rng = np.random.default_rng(4)
    n = 4000
    pairs = [stacked(process.draw(rng, TIMES, 2)) for _ in range(n)]
    first, second = np.stack(pairs, axis=1)
    shared = process.parent.covariance(TIMES)
    spread = np.sqrt(np.outer(*[np.diag(process.covariance(TIMES))] * 2))
    np.testing.assert_allclose(
        first.T @ second / n / spread, shared / spread, atol=5 * np.sqrt(2 / n)
    )


def test_the_same_seed_gives_the_same_bytes(process):
    one, other = (process.draw(np.random.default_rng(7), TIMES, 3) for _ in range(2))
    assert [child.values.tobytes() for child in one] == [child.values.tobytes() for child in other]
    layers = [Layer.random(np.random.default_rng(7), 3, 2, 1.0).lengthscales for _ in range(2)]
    assert layers[0].tobytes() == layers[1].tobytes()


def test_children_are_recordings_with_names_of_their_own(process):
    children = process.draw(np.random.default_rng(5), TIMES, 3)
    assert [child.name for child in children] == ["child-1", "child-2", "child-3"]
    assert children[0].channels == ("output-1", "output-2")
    assert children[0].values.shape == (6, 2)
    assert process.n_outputs == 2


def test_without_noise_and_children_alike_the_draw_is_the_parent(process):
    still = ToyProcess(
        process.parent, Layer(0.0 * process.child.coregionalisation, np.ones(3)), 0.0
    )
    first, second = still.draw(np.random.default_rng(6), TIMES, 2)
    # What is left is the nugget of the root: 1e-9 in variance.
    np.testing.assert_allclose(first.values, second.values, atol=1e-3)


def test_a_family_is_a_parent_and_the_children_that_a_draw_gives(process):
    parent, family = process.draw_family(np.random.default_rng(7), TIMES, 3)
    children = process.draw(np.random.default_rng(7), TIMES, 3)
    assert [child.values.tobytes() for child in family] == [c.values.tobytes() for c in children]
    assert parent.name == "parent"
    assert parent.values.shape == (6, 2)


def test_weights_between_0_and_1_correlate_every_pair_of_outputs_positively():
    layer = Layer.random(np.random.default_rng(8), 4, 3, 1.0, uniform_weights)
    assert (layer.coregionalisation > 0).all()
    assert (Layer.random(np.random.default_rng(8), 4, 3, 1.0).coregionalisation < 0).any()
