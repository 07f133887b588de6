import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.datasets import Recording

VALUES = np.array([[1.0, 2.0], [np.nan, np.nan], [5.0, np.nan]])
RECORDING = Recording("r", np.arange(3.0), VALUES, ("knee", "hip"), ("deg",) * 2)
WHOLE = np.full((3, 2), 4.0)


@pytest.mark.parametrize("mean", [4.0, [4.0, 4.0], np.full((3, 1), 4.0), WHOLE], ids=str)
def test_what_broadcasts_to_a_recording_fills_it(mean):
    prediction = Prediction.around(RECORDING, mean, mean)
    np.testing.assert_array_equal(prediction.mean, [[1, 2], [4, 4], [5, 4]])
    np.testing.assert_array_equal(prediction.variance, [[0, 0], [4, 4], [0, 4]])


WRONG = [
    ("abc", "real numbers"),
    (WHOLE + 1j, "real numbers"),
    (WHOLE[:2], r"that broadcasts to its shape \(3, 2\) .*got shape \(2, 2\)"),
    (WHOLE[None], r"that broadcasts to its shape \(3, 2\) .*got shape \(1, 3, 2\)"),
    (np.ones(3), r"that broadcasts to its shape \(3, 2\) .*got shape \(3,\)"),
]


@pytest.mark.parametrize(("wrong", "expected"), WRONG, ids=str)
def test_what_does_not_fit_a_recording_is_refused(wrong, expected):
    with pytest.raises(ValueError, match=f"mean .*{expected}"):
        Prediction.around(RECORDING, wrong)
    with pytest.raises(ValueError, match=f"variance .*{expected}"):
        Prediction.around(RECORDING, WHOLE, wrong)


@pytest.mark.parametrize(
    ("mean", "variance", "expected"),
    [
        ("abc", None, "mean of a prediction to be real numbers"),
        (np.ones(3), None, r"mean of shape \(frames, channels\), got shape \(3,\)"),
        (WHOLE, WHOLE[:2], r"variance of the shape \(3, 2\) of the mean, got \(2, 2\)"),
        (WHOLE, -WHOLE, "variances of at least 0, got -4"),
    ],
)
def test_what_is_no_distribution_is_no_prediction(mean, variance, expected):
    with pytest.raises(ValueError, match=expected):
        Prediction(mean, variance)


def test_a_variance_may_be_below_zero_by_rounding():
    assert Prediction(WHOLE, np.full((3, 2), -1e-15)).variance.min() == -1e-15


def test_a_recording_without_frames_has_a_prediction():
    empty = RECORDING.frames([])
    assert Prediction.around(empty, WHOLE[:0], WHOLE[:0]).mean.shape == (0, 2)
