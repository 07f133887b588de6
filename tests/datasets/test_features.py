"""Each paper's channels; on real recordings, numbers that the papers print."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from mocapbench.datasets import (
    THESIS_CHANNELS,
    GaitLibrary,
    Recording,
    gpdm_features,
    hlm_features,
    resample,
    zero_based_frames,
)
from mocapbench.datasets.features import smoothness, thesis_candidates


@pytest.fixture(scope="module")
def walk():
    return GaitLibrary().recording("01_01")


def test_the_thesis_has_39_of_44_candidates(walk):
    candidates = thesis_candidates(walk).channels
    assert len(candidates) == 44
    assert len(set(THESIS_CHANNELS)) == 39
    assert set(candidates) - set(THESIS_CHANNELS) == {
        *("lowerneck.rz", "upperneck.rz", "upperback.rx", "rfemur.ry", "head.rz")
    }


def test_smoothness_is_the_log_ratio_of_the_variances():
    values = np.array([[0.0, 1.0], [1.0, 1.0], [3.0, 1.0]])
    recording = Recording("ramp", [0, 1, 2], values, ("a", "b"), ("", ""))
    expected = np.log10(np.var([0, 1, 3]) / np.var([1, 2]))
    np.testing.assert_allclose(smoothness(recording), [expected, np.nan])


def test_gpdm_has_44_angles_three_rotations_and_three_differences(walk):
    features = gpdm_features(walk)
    assert len([name for name in features.channels if not name.startswith("root.")]) == 44
    assert {name for name in features.channels if name.startswith("root.")} == {
        *("root.rx", "root.ry", "root.rz", "root.dtx", "root.dty", "root.dtz")
    }
    np.testing.assert_array_equal(features.times, walk.times[::4])
    path = walk.select(["root.tz"]).values[::4, 0]
    difference = features.select(["root.dtz"]).values[:, 0]
    np.testing.assert_allclose(difference, np.append(np.diff(path), path[-1] - path[-2]))


def test_hlm_keeps_all_62_channels(walk):
    features = hlm_features(walk)
    assert features.values.shape == (len(walk.values[::4]), 62)
    angles = [name for name in walk.channels if not name.startswith("root.t")]
    np.testing.assert_array_equal(features.select(angles).values, walk.select(angles).values[::4])


def test_hlm_removes_whole_turns_from_joints_but_not_from_the_root(walk):
    turns = np.where([name in ("rthumb.rz", "root.ry") for name in walk.channels], 360.0, 0.0)
    turned = walk.with_values(walk.values - 3 * turns)
    joints = [name for name in walk.channels if not name.startswith("root.")]
    features, expected = hlm_features(turned), hlm_features(walk)
    np.testing.assert_allclose(features.select(joints).values, expected.select(joints).values)
    heading = features.select(["root.ry"]).values - expected.select(["root.ry"]).values
    np.testing.assert_allclose(heading, -1080.0)


@pytest.mark.recordings
def test_the_thesis_channels_follow_from_the_criterion(cmu):
    walks = [
        resample(zero_based_frames(thesis_candidates(cmu.recording(uri)), 0, 298), 90)
        for uri in ("cmu:02_01", "cmu:02_02", "cmu:07_02")
    ]
    order = np.argsort(np.mean([smoothness(walk) for walk in walks], axis=0))
    kept = sorted(order[5:])
    assert tuple(walks[0].channels[column] for column in kept) == THESIS_CHANNELS


@pytest.mark.recordings
@pytest.mark.parametrize(
    ("uri", "published"),
    [
        ("cmu:35_03", 62.98),
        ("cmu:16_21", 100.10),
        ("cmu:07_01", 90.83),
        ("cmu:07_02", 93.45),
        ("cmu:08_01", 139.75),
        ("cmu:08_02", 128.01),
    ],
)
def test_a_spline_through_the_features_gives_the_papers_errors(cmu, uri, published):
    """GPDM Table 2, cubic spline: 31 hidden frames of 50, in twelve windows."""
    features = gpdm_features(zero_based_frames(cmu.recording(uri), 0, 200)).values
    frames = np.arange(50)
    errors = []
    for first in range(4, 16):
        hidden = (frames >= first) & (frames < first + 31)
        filled = CubicSpline(frames[~hidden], features[~hidden])(frames[hidden])
        errors.append(np.linalg.norm(filled - features[hidden], axis=1).mean())
    assert np.mean(errors) == pytest.approx(published, abs=0.01)
