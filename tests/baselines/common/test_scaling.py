import numpy as np
import pytest

from mocapbench.baselines.common.scaling import Standardisation, unit_scales
from mocapbench.datasets import Recording


def _recording(values, units=None):
    values = np.asarray(values, dtype=float)
    channels = tuple(f"c{d}" for d in range(values.shape[1]))
    units = units or ("",) * len(channels)
    return Recording("one", np.arange(len(values)), values, channels, units)


def test_visible_entries_get_zero_mean_and_unit_variance():
    values = np.random.default_rng(0).normal(3.0, 7.0, (30, 2))
    values[4:9, 1] = np.nan
    recording = _recording(values)
    scaling = Standardisation.of([recording])
    scaled = scaling.apply(recording).values
    np.testing.assert_allclose(np.nanmean(scaled, axis=0), 0.0, atol=1e-14)
    np.testing.assert_allclose(np.nanstd(scaled, axis=0), 1.0, rtol=1e-14)
    np.testing.assert_allclose(scaling.restore(scaled), values, rtol=1e-13)


def test_a_constant_output_keeps_its_unit():
    scaling = Standardisation.of([_recording(np.full((9, 1), 0.1))])
    assert scaling.scale == [1.0]
    assert scaling.log_jacobian == 0.0


def test_an_output_that_is_nowhere_visible_is_named():
    with pytest.raises(ValueError, match=r"c1.*Recording.select"):
        Standardisation.of([_recording([[1.0, np.nan], [2.0, np.nan]])])


def test_channels_of_one_unit_share_the_root_of_their_mean_variance():
    values = np.random.default_rng(0).normal(3.0, [1.0, 5.0, 0.2, 1.0], (30, 4))
    values[4:9, 1] = np.nan
    values[:, 3] = np.nan
    recordings = [_recording(part, ("deg", "deg", "cm", "cm")) for part in np.split(values, 2)]
    seen = [np.nanvar(values[:, d]) for d in range(3)]
    degrees, centimetres = np.sqrt((seen[0] + seen[1]) / 2), np.sqrt(seen[2] / 2)
    expected = [degrees, degrees, centimetres, centimetres]
    np.testing.assert_allclose(unit_scales(recordings), expected, rtol=1e-13)


def test_a_unit_whose_channels_are_constant_keeps_its_scale():
    assert unit_scales([_recording(np.full((9, 2), 0.1), ("deg", "cm"))]).tolist() == [1.0, 1.0]
