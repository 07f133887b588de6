import numpy as np
import pytest
from sklearn.exceptions import NotFittedError

from mocapbench.baselines.trivial import Trivial
from mocapbench.datasets import Recording
from mocapbench.metrics import Imputation, msll


def recording(name, values, channels=("a", "b")):
    values = np.asarray(values, dtype=float)
    return Recording(name, np.arange(len(values)), values, channels, ("",) * len(channels))


def test_moments_are_those_of_visible_entries():
    first = recording("first", [[1.0, np.nan], [3.0, 4.0]])
    second = recording("second", [[5.0, 8.0], [np.nan, 6.0]])
    one, two = Trivial().fit([first, second]).impute([first, second])
    np.testing.assert_array_equal(one.mean, [[1.0, 6.0], [3.0, 4.0]])
    np.testing.assert_allclose(one.variance, [[0.0, 8 / 3], [0.0, 0.0]])
    np.testing.assert_allclose(two.mean, [[5.0, 8.0], [3.0, 6.0]])


def test_a_new_recording_counts_and_a_known_one_counts_once():
    known = recording("known", [[0.0, 0.0], [np.nan, np.nan]])
    new = recording("new", [[2.0, 4.0], [np.nan, np.nan]])
    model = Trivial().fit([known])
    np.testing.assert_array_equal(model.impute([known])[0].mean, np.zeros((2, 2)))
    np.testing.assert_array_equal(model.impute([new])[0].mean[1], [1.0, 2.0])


def test_its_standardised_log_loss_is_zero():
    rng = np.random.default_rng(0)
    truth = rng.normal(size=(2, 30, 2))
    hidden = rng.random((30, 2)) < 0.4
    train = recording("train", truth[0])
    given = recording("given", truth[1]).hide(hidden)
    prediction = Trivial().fit([train]).impute([given])[0]
    visible = np.concatenate([train.values, given.values])
    outcome = Imputation(
        truth[1],
        prediction.mean,
        prediction.variance,
        hidden,
        np.nanmean(visible, axis=0),
        np.nanvar(visible, axis=0),
    )
    assert msll(outcome).value == pytest.approx(0.0, abs=1e-12)


def test_a_constant_channel_has_a_positive_variance():
    constant = recording("constant", [[7.0, 1.0], [np.nan, np.nan]])
    assert (Trivial().fit([constant]).impute([constant])[0].variance[1] > 0).all()


def test_what_it_refuses():
    blind = recording("blind", [[np.nan, 1.0]])
    with pytest.raises(ValueError, match=r"none of \['a'\]"):
        Trivial().fit([blind]).impute([blind])
    with pytest.raises(ValueError, match="at least one recording"):
        Trivial().fit([])
    with pytest.raises(ValueError, match="distinct names"):
        Trivial().fit([blind, blind])
    with pytest.raises(ValueError, match="expected channels"):
        Trivial().fit([blind, recording("other", [[1.0, 1.0]], ("a", "c"))])
    with pytest.raises(NotFittedError):
        Trivial().impute([blind])
