import numpy as np
import pytest

from mocapbench.baselines.functional.components import (
    ComponentFit,
    cycle_moments,
    prototypes,
    sample_curves,
)
from mocapbench.baselines.functional.fourier_series import fourier

RNG = np.random.default_rng(0)
COMPONENTS = RNG.normal(size=(3, 2, 5)), np.array([0.1, 0.3])


def test_moments_are_those_of_entries_that_are_drawn():
    root = 0.3 * RNG.normal(size=(2, 2))
    fit = ComponentFit(*COMPONENTS, np.array([[0.5, -1.0]]), (root @ root.T)[None], np.zeros(1))
    phases = RNG.random(4)
    mean, variance = cycle_moments([phases], fit)
    draws = fit.mean[0] + RNG.normal(size=(100_000, 2)) @ root.T
    padded = np.hstack([np.ones((len(draws), 1)), draws])
    curves = np.einsum("np,adp,sa->snd", fourier(phases, 2), fit.coefficients, padded)
    np.testing.assert_allclose(mean, curves.mean(axis=0), atol=0.02)
    np.testing.assert_allclose(variance, curves.var(axis=0) + fit.noise, rtol=0.05)


def test_a_prototype_is_the_mean_of_cycles_by_their_visible_entries():
    fit = ComponentFit(*COMPONENTS, RNG.normal(size=(4, 2)), np.zeros((4, 2, 2)), np.zeros(4))
    found = prototypes(fit, np.array([30.0, 60.0, 30.0, 120.0]), np.array([0, 0, 0, 1]))
    by_cycle = np.einsum("ja,adp->jdp", fit.padded, fit.coefficients)
    expected = [0.25 * by_cycle[0] + 0.5 * by_cycle[1] + 0.25 * by_cycle[2], by_cycle[3]]
    np.testing.assert_allclose(found, expected)


@pytest.mark.parametrize("n_states", [5, 12])
def test_functions_are_sampled_at_the_starts_of_states(n_states):
    found = sample_curves(COMPONENTS[0][0], n_states)
    expected = fourier(np.arange(n_states) / n_states, 2) @ COMPONENTS[0][0].T
    np.testing.assert_allclose(found, expected)
