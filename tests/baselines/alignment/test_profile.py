import numpy as np

from mocapbench.baselines.alignment.model import Hyperparameters
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.profile import fit_profile, prototype
from mocapbench.baselines.alignment.sequences import Sequences


def test_em_never_lowers_the_penalised_likelihood():
    rng = np.random.default_rng(0)
    arrays = [rng.normal(size=(n, 3)).cumsum(axis=0) for n in (12, 20, 1)]
    arrays[1][4:9, 1] = np.nan
    hyper = Hyperparameters(0.1, PRIORS["normalised"])
    run = fit_profile(
        rng.normal(size=(9, 3)),
        Sequences.of(arrays),
        hyper,
        max_jump=2,
        max_iter=30,
        tolerance=0.0,
    )
    assert (np.diff(run.bounds) >= -1e-9 * np.abs(run.bounds[1:])).all()
    assert run.bounds[-1] > run.bounds[0] + 1.0


def test_a_prototype_averages_the_cycles_and_bridges_what_is_skipped_or_hidden():
    frames = np.array([[0.0], [2.0], [np.nan], [6.0], [8.0]])
    path = np.array([0, 2, 3, 1, 3])  # of five states: once round and on
    cycle = prototype(frames, path, np.full((5, 1), 99.0))
    warped = np.interp(np.arange(9), [0, 2, 6, 8], [0.0, 2.0, 6.0, 8.0])
    expected = [np.mean(warped[m::5]) for m in range(5)]
    np.testing.assert_allclose(cycle[:, 0], expected)


def test_a_prototype_is_the_trace_where_the_sequence_never_comes():
    cycle = prototype(np.array([[1.0], [2.0]]), np.array([1, 2]), np.full((4, 1), 99.0))
    np.testing.assert_array_equal(cycle[:, 0], [99.0, 1.0, 2.0, 99.0])
