"""Hidden entries given the visible ones of their frames."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.inference import correct_means, error_correlation
from mocapbench.baselines.common.padded_sequences import Sequences

LOST, KNOWN = [0, 1], [2, 3]


def _problem(seed=0):
    """Correlated errors about a mean; the last sequence lacks channels 0 and 1 in a part."""
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(4, 4)) * [1.0, 10.0, 0.1, 3.0]
    truth = [rng.normal(size=(n, 4)) @ factor for n in (300, 200, 120)]
    arrays = [array.copy() for array in truth]
    arrays[-1][60:, LOST] = np.nan
    sequences = Sequences.of(arrays)
    return truth[-1], np.zeros_like(sequences.values), sequences


def test_the_correction_is_the_regression_on_visible_errors():
    truth, mean, sequences = _problem()
    seen = (sequences.values - mean)[sequences.frames]
    unit = np.sqrt((seen**2).mean(axis=0))
    covariance = error_correlation(seen / unit) * np.outer(unit, unit)
    gain = np.linalg.inv(covariance[np.ix_(KNOWN, KNOWN)]) @ covariance[np.ix_(KNOWN, LOST)]
    filled = correct_means(mean, sequences)
    np.testing.assert_allclose(filled[60:, LOST], truth[60:, KNOWN] @ gain, rtol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_correlated_errors_are_lessened(seed):
    truth, mean, sequences = _problem(seed)
    hidden = (slice(60, None), LOST)
    error = (correct_means(mean, sequences) - truth)[hidden]
    assert (error**2).mean() < (truth[hidden] ** 2).mean()


def test_units_of_channels_mean_nothing():
    _, mean, sequences = _problem()
    factor = np.array([1e-3, 1.0, 50.0, 7.0])
    scaled = Sequences.of([array * factor for array in sequences.arrays()])
    expected = correct_means(mean, sequences) * factor
    np.testing.assert_allclose(correct_means(mean * factor, scaled), expected, rtol=1e-9)


def test_whole_hidden_and_whole_visible_frames_stay_as_they_were():
    _, mean, sequences = _problem()
    arrays = sequences.arrays()
    arrays[-1][60:] = np.nan
    np.testing.assert_array_equal(correct_means(mean, Sequences.of(arrays)), mean[-1, :120])


def test_where_there_are_no_errors_nothing_changes():
    _, _, sequences = _problem()
    filled = correct_means(sequences.values, sequences)
    np.testing.assert_array_equal(filled, sequences.values[-1, :120])
