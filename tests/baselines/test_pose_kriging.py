import numpy as np
import pytest

from mocapbench.baselines.pose_kriging import PoseKriging
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.datasets import Recording

STEP = 2 * np.pi / 20.3


def walk(name, start, n_frames, style=0.0):
    """Return a cycle of three channels, from which a style deviates as a function of the phase."""
    angle = STEP * (start + np.arange(n_frames))
    values = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1.0)])
    values = values + style * np.column_stack([np.cos(2 * angle), np.sin(angle), 1 + 0 * angle])
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b", "c"), ("",) * 3)


def gap(recording, first, last):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[first:last] = True
    return recording.hide(hidden)


TRAINING = [walk("one", 0, 50), walk("two", 3, 45)]


def error(model, truth, first, last):
    (filled,) = model.fit(TRAINING).impute([gap(truth, first, last)])
    return np.sqrt(np.mean((filled.mean - truth.values)[first:last] ** 2))


@pytest.mark.parametrize(("first", "last"), [(8, 20), (0, 10), (30, 40)])
def test_training_motion_is_found_wherever_the_gap_is(first, last):
    assert error(PoseKriging(), walk("new", 5, 40), first, last) < 0.03


def test_a_style_that_repeats_with_the_pose_is_carried_into_the_gap():
    truth = walk("new", 2, 44, style=0.2)
    with_poses = error(PoseKriging(), truth, 26, 38)
    assert with_poses < 0.7 * error(PoseViterbi(), truth, 26, 38)
    assert with_poses < 0.7 * error(PoseKriging(pose_variance=0.0), truth, 26, 38)


def test_the_fill_moves_with_a_constant_offset():
    model = PoseKriging().fit(TRAINING)
    truth = walk("new", 5, 40)
    (here,) = model.impute([gap(truth, 8, 20)])
    (there,) = model.impute([gap(truth.with_values(truth.values + 0.01), 8, 20)])
    np.testing.assert_allclose(there.mean - here.mean, 0.01, atol=2e-3)


def test_mean_and_variance_are_those_of_the_joint_normal():
    model = PoseKriging().fit(TRAINING)
    recording = gap(walk("new", 2, 30, style=0.2), 10, 16)
    matched = model._matched(recording)
    mean, variance = model._kriged(recording, matched)
    visible = recording.visible[:, 0]
    covariance = model._covariance(matched) + 0.05 * np.eye(30)
    precision = np.linalg.inv(covariance)
    hidden = ~visible
    block = np.linalg.inv(precision[np.ix_(hidden, hidden)])
    residual = (recording.values - matched)[visible]
    expected = matched[hidden] - block @ precision[np.ix_(hidden, visible)] @ residual
    np.testing.assert_allclose(mean[hidden], expected, atol=1e-8)
    inverse = np.linalg.inv(covariance[np.ix_(visible, visible)])
    scales = np.diag(residual.T @ inverse @ residual) / visible.sum()
    np.testing.assert_allclose(variance[hidden], np.outer(np.diag(block), scales), rtol=1e-6)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"pose_lengthscale": 0.0}, "pose_lengthscale to be a finite positive"),
        ({"time_lengthscale": -1.0}, "time_lengthscale to be a finite positive"),
        ({"pose_variance": -1.0}, "pose_variance to be a finite number of at least 0"),
        ({"smoothness": "1"}, "smoothness to be a finite positive"),
    ],
)
def test_parameters_are_validated(parameters, message):
    with pytest.raises(ValueError, match=message):
        PoseKriging(**parameters).fit(TRAINING)


def test_what_cannot_be_filled_is_refused():
    with pytest.raises(ValueError, match="two consecutive complete frames"):
        PoseKriging().fit([walk("one", 0, 1)])
    model = PoseKriging().fit(TRAINING)
    with pytest.raises(ValueError, match="'new': expected a visible frame"):
        model.impute([gap(walk("new", 0, 5), 0, 5)])
    with pytest.raises(ValueError, match="expected channels"):
        model.impute([walk("new", 0, 5).select(["a"])])
