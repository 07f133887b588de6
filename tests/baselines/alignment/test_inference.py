import numpy as np

from mocapbench.baselines.alignment.cycle_model import Hyperparameters, entry_moments
from mocapbench.baselines.alignment.inference import infer_path, refine_state
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import run_from_random_start
from mocapbench.baselines.common.padded_sequences import Sequences

HYPER = Hyperparameters(
    0.1,
    PRIORS["normalised"],
    closeness=0.1,
    smoothness=0.1,
    max_jump=2,
    n_styles=2,
    n_inner=2,
    tol=0.0,
)


def _fitted():
    rng = np.random.default_rng(0)
    waves = [np.sin(np.arange(n)[:, None] + np.arange(3)) for n in (20, 25, 30)]
    sequences = Sequences.of([wave + 0.1 * rng.normal(size=wave.shape) for wave in waves])
    runs = [run_from_random_start(sequences, 12, HYPER, 10, rng) for _ in range(3)]
    return sequences, max(runs, key=lambda run: run.objectives[-1]).state


def test_moments_are_those_of_the_mixture():
    _, state = _fitted()
    mean, variance = entry_moments(state)
    weights = np.einsum("nm,c->nmc", state.paths.occupancy[1], state.labels[1])
    mu, noise = state.cycles.mean, 1.0 / state.precisions
    expected = np.einsum("nmc,mcf->nf", weights, mu)
    squares = (mu[None] - expected[:, None, None]) ** 2 + state.cycles.variance + noise
    np.testing.assert_allclose(mean[1], expected, atol=1e-12)
    np.testing.assert_allclose(variance[1], np.einsum("nmc,nmcf->nf", weights, squares), rtol=1e-9)


def test_a_new_sequence_changes_nothing_but_its_own_factors():
    sequences, state = _fitted()
    new = infer_path(sequences.rows(np.array([1])), state, HYPER)
    assert new.cycles is state.cycles
    np.testing.assert_allclose(new.labels.sum(axis=1), 1.0)
    np.testing.assert_allclose(new.labels[0], state.labels[1], atol=1e-3)


def test_refining_a_sequence_without_evidence_leaves_the_mixture_of_all():
    sequences, state = _fitted()
    blank = Sequences.of([np.full((6, 3), np.nan)])
    refined = refine_state(blank, state, sequences, HYPER, 3)
    assert refined.labels.shape == (4, 2)
    assert np.isfinite(entry_moments(refined)[0]).all()
    np.testing.assert_allclose(refined.paths.occupancy[3, :6].sum(axis=1), 1.0)
