import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_start import autocorrelation, cycle_length
from mocapbench.baselines.common.padded_sequences import Sequences


def _waves(period, lengths, hidden=0.0):
    rng = np.random.default_rng(0)
    phases = np.array([0.0, 1.0, 2.5])
    arrays = [
        np.sin(2 * np.pi * np.arange(n)[:, None] / period + phases)
        + 0.5 * np.sin(4 * np.pi * np.arange(n)[:, None] / period + phases**2)
        + 0.1 * rng.normal(size=(n, 3))
        for n in lengths
    ]
    return Sequences.of([np.where(rng.random(a.shape) < hidden, np.nan, a) for a in arrays])


@pytest.mark.parametrize("hidden", [0.0, 0.3])
@pytest.mark.parametrize("period", [11, 25])
def test_the_length_of_a_wave_is_found(period, hidden):
    assert abs(cycle_length(_waves(period, (80, 100, 71), hidden)) - period) <= 1


def test_sequences_that_do_not_repeat_are_taken_for_one_cycle_each():
    assert cycle_length(_waves(100, (20, 30, 40))) == 30


def test_sequences_that_show_nothing_do_not_vote():
    waves = _waves(12, (60, 60)).unpad(_waves(12, (60, 60)).values)
    assert cycle_length(Sequences.of([*waves, np.full((60, 3), np.nan)])) == 12


def test_autocorrelation_is_the_mean_product_of_visible_pairs():
    sequences = _waves(9, (15,), hidden=0.4)
    x, v = sequences.values[0], sequences.visible[0]
    centred = (x - x.sum(axis=0) / v.sum(axis=0)) * v
    means = [
        (centred[: 15 - lag] * centred[lag:]).sum() / (v[: 15 - lag] * v[lag:]).sum()
        for lag in range(10)
    ]
    np.testing.assert_allclose(autocorrelation(sequences)[0, :10], np.array(means) / means[0])
