import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.oracle import Oracle
from mocapbench.datasets import ToyProcess

TIMES = np.linspace(0.0, 2 * np.pi, 7)


def drawn(seed, noise=0.05, n_replicates=5):
    rng = np.random.default_rng(seed)
    process = ToyProcess.random(rng, n_outputs=2, noise=noise)
    return process, list(process.draw(rng, TIMES, n_replicates)), rng


def brute_force(process, recordings):
    """Condition the joint Gaussian of all entries of all recordings."""
    n_replicates, n = len(recordings), 2 * len(TIMES)
    within = process.child.covariance(TIMES) + process.noise * np.eye(n)
    covariance = np.kron(np.ones((n_replicates, n_replicates)), process.parent.covariance(TIMES))
    covariance += np.kron(np.eye(n_replicates), within)
    values = np.concatenate([recording.values.T.ravel() for recording in recordings])
    seen = ~np.isnan(values)
    cross = covariance[np.ix_(~seen, seen)]
    solved = np.linalg.solve(covariance[np.ix_(seen, seen)], cross.T).T
    mean, variance = values.copy(), np.zeros_like(values)
    mean[~seen] = solved @ values[seen]
    variance[~seen] = np.diag(covariance)[~seen] - np.sum(solved * cross, axis=1)
    shape = (n_replicates, 2, len(TIMES))
    return mean.reshape(shape).transpose(0, 2, 1), variance.reshape(shape).transpose(0, 2, 1)


@given(seed=st.integers(0, 2**32 - 1), n_masks=st.integers(1, 4))
def test_it_is_the_joint_gaussian_conditioned(seed, n_masks):
    process, recordings, rng = drawn(seed)
    masks = rng.random((n_masks, len(TIMES), 2)) < 0.5
    masks[0, 0] = False
    given = [recording.hide(masks[r % n_masks]) for r, recording in enumerate(recordings)]
    mean, variance = brute_force(process, given)
    predictions = Oracle().fit(given, process).impute(given)
    np.testing.assert_allclose([p.mean for p in predictions], mean, atol=1e-9)
    np.testing.assert_allclose([p.variance for p in predictions], variance, atol=1e-9)


def test_a_child_that_shows_nothing_is_predicted_from_its_siblings():
    process, recordings, _ = drawn(0)
    given = [*recordings[:-1], recordings[-1].hide(np.ones((len(TIMES), 2), dtype=bool))]
    mean, variance = brute_force(process, given)
    prediction = Oracle().fit(given, process).impute(given[-1:])[0]
    np.testing.assert_allclose(prediction.mean, mean[-1], atol=1e-9)
    np.testing.assert_allclose(prediction.variance, variance[-1], atol=1e-9)


def test_recordings_may_have_grids_of_their_own():
    process, recordings, _ = drawn(1)
    even, odd = recordings[0].frames([0, 2, 4, 6]), recordings[1].frames([1, 3, 5])
    other = odd.hide(np.array([[False, False], [True, False], [False, True]]))
    padded = []
    for recording, rows in ((even, [0, 2, 4, 6]), (other, [1, 3, 5])):
        values = np.full((len(TIMES), 2), np.nan)
        values[rows] = recording.values
        padded.append(recordings[0].with_values(values))
    mean, variance = brute_force(process, padded)
    prediction = Oracle().fit([even, other], process).impute([other])[0]
    np.testing.assert_allclose(prediction.mean, mean[1, [1, 3, 5]], atol=1e-9)
    np.testing.assert_allclose(prediction.variance, variance[1, [1, 3, 5]], atol=1e-9)


def test_its_standardised_errors_have_unit_variance():
    squares = []
    for seed in range(200):
        process, recordings, rng = drawn(seed, n_replicates=3)
        hidden = rng.random((len(TIMES), 2)) < 0.5
        hidden[0], hidden[1] = True, False
        given = [*recordings[:-1], recordings[-1].hide(hidden)]
        prediction = Oracle().fit(given, process).impute(given[-1:])[0]
        errors = (prediction.mean - recordings[-1].values)[hidden]
        squares.append(np.mean(errors**2 / prediction.variance[hidden]))
    assert np.mean(squares) == pytest.approx(1.0, abs=4 * np.std(squares) / np.sqrt(len(squares)))


def test_what_it_refuses():
    process, recordings, _ = drawn(2)
    with pytest.raises(
        ValueError, match="expected a process that generated the recordings, got None"
    ):
        Oracle().fit(recordings)
    with pytest.raises(ValueError, match="2 outputs"):
        Oracle().fit([recordings[0].select(["output-1"])], process)
    with pytest.raises(ValueError, match=r"expected recordings given to fit, .*, got"):
        Oracle().fit(recordings[:-1], process).impute(recordings[-1:])
    with pytest.raises(ValueError, match="visible entries to condition on"):
        Oracle().fit([recordings[0].hide(np.ones((len(TIMES), 2), dtype=bool))], process)


def test_the_trend_is_the_parent_given_the_children():
    process, recordings, rng = drawn(3)
    given = [recording.hide(rng.random((len(TIMES), 2)) < 0.4) for recording in recordings]
    apart = np.array([-0.3, 2.5])
    joint = process.parent.covariance(np.concatenate([apart, TIMES])).reshape(2, 9, 2, 9)
    within = process.child.covariance(TIMES) + process.noise * np.eye(14)
    shared = np.kron(np.ones((5, 5)), joint[:, 2:, :, 2:].reshape(14, 14))
    values = np.concatenate([recording.values.T.ravel() for recording in given])
    seen = ~np.isnan(values)
    covariance = (shared + np.kron(np.eye(5), within))[np.ix_(seen, seen)]
    cross = np.tile(joint[:, :2, :, 2:].reshape(4, 14), 5)[:, seen]
    solved = np.linalg.solve(covariance, cross.T).T
    prior = np.diag(joint[:, :2, :, :2].reshape(4, 4))
    mean, variance = Oracle().fit(given, process).trend(apart)
    np.testing.assert_allclose(mean.T.ravel(), solved @ values[seen], atol=1e-9)
    np.testing.assert_allclose(variance.T.ravel(), prior - (solved * cross).sum(axis=1), atol=1e-9)
