"""The Gaussian process of windows beside brute force, and what it learns from."""

import numpy as np
import pytest

from mocapbench.baselines import ProcessForecast
from mocapbench.datasets import Recording

NAMES = ("LeftArm", "RightArm", "LeftLeg", "RightLeg")
CHANNELS = tuple(f"{name}.{axis}" for name in NAMES for axis in "xyz")
PARTS = (("Leg",), ("Arm", "Hand"))


def draw(name, n_frames=30, seed=0):
    """Return a smooth recording of four joints."""
    rng = np.random.default_rng([seed, *name.encode()])
    times = np.arange(float(n_frames))
    values = np.cumsum(np.cumsum(rng.normal(size=(n_frames, 12)), axis=0), axis=0)
    return Recording(name, times, values, CHANNELS, ("cm",) * 12)


TRAINING = [draw("a"), draw("b")]
NEW = draw("new", 11)
GIVEN = NEW.hide((np.arange(11) > 6)[:, None])


def describe(window):
    """Return the last pose and its steps, of the last seen frame of a window of 5."""
    last = window[4]
    bend = last - 2 * window[2] + window[0]
    steps = [12 * (last - window[3]), 3 * (last - window[1]), last - window[0], 2 * bend]
    return np.concatenate([last, *steps])


def relate(one, other, centre, spreads, of_parts):
    value = (one - centre) @ (other - centre) / (1.5 * spreads[0]) ** 2
    for share, columns, spread in zip((1, 0.5, 0.5), of_parts, spreads, strict=True):
        apart = ((one - other)[columns] ** 2).sum()
        value += share / (1 + apart / (2 * (1.2 * spread) ** 2))
    return value


def mirror(values):
    swapped = values.reshape(len(values), 4, 3)[:, [1, 0, 3, 2]] * [-1, 1, 1]
    return swapped.reshape(len(values), 12)


def predict_by_force():
    """Return what follows, by the posterior mean with the noise of each window, written out."""
    recordings = [r.values for r in TRAINING] + [mirror(r.values) for r in TRAINING]
    windows = [values[start : start + 9] for values in recordings for start in range(22)]
    steps = np.array([describe(window) for window in windows])
    ahead = np.array([(window[5:] - window[4]).ravel() for window in windows])
    legs = np.tile(["Leg" in name for name in CHANNELS], 5)
    of_parts = [np.full(60, True), legs, ~legs]
    spreads = [np.sqrt(steps[:, part].var(axis=0).sum()) for part in of_parts]
    centre = steps.mean(axis=0)
    prior = np.array([[relate(a, b, centre, spreads, of_parts) for a in steps] for b in steps])
    errors = []
    for left in range(len(steps)):
        others = np.arange(len(steps)) != left
        rest = prior[np.ix_(others, others)] + 0.05 * np.eye(others.sum())
        errors.append(ahead[left] - prior[left, others] @ np.linalg.solve(rest, ahead[others]))
    sizes = np.linalg.norm(errors, axis=1)
    noise = 0.05 * (sizes / np.median(sizes) + 0.2) / 1.2
    new = describe(NEW.values[2:7])
    covariance = [relate(new, one, centre, spreads, of_parts) for one in steps]
    apart = covariance @ np.linalg.solve(prior + np.diag(noise), ahead)
    return NEW.values[6] + apart.reshape(4, 12)


def test_the_prediction_is_the_posterior_mean_with_noise_from_errors_of_windows_left_out():
    model = ProcessForecast(n_seen=5, n_ahead=4, parts=PARTS).fit(TRAINING)
    (prediction,) = model.impute([GIVEN])
    np.testing.assert_allclose(prediction.mean[7:], predict_by_force(), rtol=1e-6)


def test_a_mirrored_motion_is_continued_as_the_mirror_image():
    model = ProcessForecast(n_seen=5, n_ahead=4, parts=PARTS).fit(TRAINING)
    (one,) = model.impute([GIVEN])
    (other,) = model.impute([GIVEN.with_values(mirror(GIVEN.values))])
    np.testing.assert_allclose(other.mean, mirror(one.mean), rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize(("most", "n"), [(88, 88), (50, 44), (30, 30), (1, 1)])
def test_windows_are_taken_at_intervals_so_that_they_are_not_too_many(most, n):
    model = ProcessForecast(n_seen=5, n_ahead=4, max_windows=most).fit(TRAINING)
    assert len(model._weights) == n


def test_the_unit_of_length_changes_nothing_but_the_unit():
    in_metres = [r.with_values(r.values / 100) for r in (*TRAINING, GIVEN)]
    model = ProcessForecast(n_seen=5, n_ahead=4, parts=PARTS)
    (one,) = model.fit(TRAINING).impute([GIVEN])
    (other,) = model.fit(in_metres[:-1]).impute(in_metres[-1:])
    np.testing.assert_allclose(100 * other.mean, one.mean, rtol=1e-6)


@pytest.mark.parametrize("wrong", ["Leg", 3, None, ("Leg",), [[]], [[1]]])
def test_parts_are_lists_of_words(wrong):
    with pytest.raises(ValueError, match="expected parts to be a list of words for each part"):
        ProcessForecast(n_seen=5, n_ahead=4, parts=wrong).fit(TRAINING)
