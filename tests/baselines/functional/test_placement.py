import numpy as np
import pytest

from mocapbench.baselines.functional.fourier_series import CurveStatistics
from mocapbench.baselines.functional.phases import periodic_curve, place_recording


@pytest.fixture(scope="module")
def curve(waves):
    cyclic = waves([20.0, 25.0], noise=0.01)
    pairs = [(p, r.values) for p, r in zip(cyclic.phases, cyclic.recordings, strict=True)]
    return periodic_curve(CurveStatistics.of(pairs, 4), 1e-3)


@pytest.mark.parametrize("visible", [np.arange(90), np.r_[0:6, 40:50], np.arange(0, 90, 5)])
def test_a_new_recording_is_placed_by_what_is_visible(waves, curve, visible):
    new = waves([22.0], seed=3)
    hidden = ~np.isin(np.arange(90), visible)
    given = new.recordings[0].hide(np.repeat(hidden[:, None], 2, axis=1))
    gaps = place_recording(given, curve, np.array([20.0, 25.0]) / 30.0) - new.phases[0]
    np.testing.assert_allclose((gaps[:50] + 0.5) % 1.0, 0.5, atol=0.05)


def test_a_recording_that_shows_nothing_has_rising_phases(waves, curve):
    (recording,) = waves([22.0], hidden=1.0).recordings
    assert (np.diff(place_recording(recording, curve, np.array([0.7]))) > 0).all()
