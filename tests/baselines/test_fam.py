from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.fam import FAM
from mocapbench.datasets import Recording

CHANNELS = ("a", "b", "c", "d")
PHASES = np.array([0.0, 0.7, 1.9, 4.0])


def _recording(name, values):
    return Recording(name, np.arange(len(values)) / 30.0, values, CHANNELS, ("deg",) * 4)


def _walk(name, n_frames=60, seed=0, *, period=20.0, noise=0.1):
    """A walk that differs from others in one respect: how much of a second curve is in it.

    The cycles of one walk are alike, because a cycle may start at any phase.
    """
    rng = np.random.default_rng(seed)
    phases = rng.random() + np.arange(n_frames) / period
    angles = 2.0 * np.pi * phases[:, None]
    sway = 2.0 * np.cos(angles + PHASES[::-1]) + [3.0, 1.0, 2.0, 4.0]
    values = 10.0 * np.sin(angles * np.array([1, 1, 2, 1]) + PHASES) + rng.normal() * sway
    return _recording(name, values + [0.0, 30.0, -5.0, 100.0] + noise * rng.normal(size=sway.shape))


WALKS = tuple(
    _walk(f"walk-{k}", 60 + 5 * k, k, period=p) for k, p in enumerate((18, 20, 22, 19, 23, 21))
)


@pytest.fixture(scope="module")
def fitted():
    return FAM(n_components=1, random_state=0).fit(WALKS)


def _hidden(recording, channels, frames=slice(20, None)):
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[frames, channels] = True
    return mask


def test_lengths_of_cycles_are_found(fitted):
    np.testing.assert_allclose(30.0 * fitted.periods_, [18, 20, 22, 19, 23, 21], rtol=0.02)
    assert fitted.cycle_length_ == 2 * 20


def test_the_likelihood_never_falls(fitted):
    assert (np.diff(fitted.log_likelihood_) >= 0).all()
    assert len(fitted.log_likelihood_) == fitted.n_iterations_ + 1


def test_shapes_and_paths(fitted):
    n_states = fitted.cycle_length_
    assert fitted.mean_cycle_.shape == (n_states, 4)
    assert fitted.components_.shape == (1, n_states, 4)
    assert fitted.prototypes_.shape == (6, n_states, 4)
    for path, offset, walk in zip(fitted.path_, fitted.offsets_, WALKS, strict=True):
        assert path.shape == walk.times.shape
        assert path[0] == int(offset * n_states)
        assert (np.diff(path) % n_states <= 3).all()


def test_aligned_frames_are_close_to_the_mean_cycle(fitted):
    gaps = [
        walk.values - fitted.mean_cycle_[path]
        for walk, path in zip(WALKS, fitted.path_, strict=True)
    ]
    stacked = np.concatenate([walk.values for walk in WALKS])
    assert np.concatenate(gaps).var() < 0.25 * stacked.var(axis=0).mean()


def test_a_new_recording_is_aligned_as_if_fitted(fitted):
    for path, again in zip(fitted.path_, fitted.align(WALKS), strict=True):
        distance = np.abs(path - again)
        assert np.minimum(distance, fitted.cycle_length_ - distance).max() <= 3


@pytest.mark.parametrize("channels", [[0], [1, 2]])
def test_data_of_the_model_are_recovered_from_the_other_channels(fitted, channels):
    new = _walk("new", 70, 99, period=20.5)
    mask = _hidden(new, channels)
    (prediction,) = fitted.impute([new.hide(mask)])
    error = (prediction.mean - new.values)[mask]
    mean_alone = FAM(n_components=0, random_state=0).fit(WALKS).impute([new.hide(mask)])[0].mean
    assert (error**2).mean() < 0.2 * ((mean_alone - new.values)[mask] ** 2).mean()
    assert (np.abs(error) < 5.0 * np.sqrt(prediction.variance[mask])).mean() > 0.9


def test_without_components_hidden_entries_are_those_of_the_mean_curve():
    model = FAM(n_components=0, random_state=0).fit(WALKS)
    assert model.components_.shape == (0, model.cycle_length_, 4)
    for prototype in model.prototypes_:
        np.testing.assert_allclose(prototype, model.mean_cycle_)
    (prediction,) = model.impute([WALKS[0].hide(_hidden(WALKS[0], [0]))])
    (path,) = model.align([WALKS[0].hide(_hidden(WALKS[0], [0]))])
    # A state is half a frame: the curve of amplitude 10 moves by less than 2 within it.
    gaps = prediction.mean[20:, 0] - model.mean_cycle_[path[20:], 0]
    assert np.abs(gaps).max() < 2.0


def test_nothing_visible_in_a_cycle_gives_the_mean_with_the_components_variance(fitted):
    given = WALKS[0].hide(_hidden(WALKS[0], slice(None), slice(5, None)))
    (prediction,), (path,) = fitted.impute([given]), fitted.align([given])
    late = np.arange(40, 60)  # the cycle of the visible frames is over
    around = fitted.mean_cycle_[(path[late] + np.arange(-1, 3)[:, None]) % fitted.cycle_length_]
    assert (prediction.mean[late] > around.min(axis=0) - 0.1).all()
    assert (prediction.mean[late] < around.max(axis=0) + 0.1).all()
    spread = (fitted.components_**2).sum(axis=0)[path[late]]
    noise = fitted.noise_ * fitted.scaling_.scale**2
    # Over a cycle, because a state is wider than a frame's distance from it
    expected = spread.mean(axis=0) + noise
    np.testing.assert_allclose(prediction.variance[late].mean(axis=0), expected, rtol=0.1)


def _filled(walks, mask):
    """Fill the first walk by as many components as walks differ in: of more, rounding decides."""
    model = FAM(n_components=1, random_state=0).fit(walks)
    return model.impute([walks[0].hide(mask)])[0]


def test_units_mean_nothing():
    factor, offset = np.array([1e-3, 1.0, 50.0, 7.0]), np.array([5.0, 0.0, -1e3, 2.0])
    other = [walk.with_values(walk.values * factor + offset) for walk in WALKS]
    mask = _hidden(WALKS[0], [0, 2])
    one, two = (_filled(walks, mask) for walks in (WALKS, other))
    np.testing.assert_allclose(two.mean, one.mean * factor + offset, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(two.variance, one.variance * factor**2, rtol=1e-5)


def test_when_recordings_start_means_nothing():
    later = [replace(walk, times=walk.times + 17.0 * k) for k, walk in enumerate(WALKS)]
    mask = _hidden(WALKS[0], [0, 2])
    one, two = (_filled(walks, mask) for walks in (WALKS, later))
    np.testing.assert_allclose(two.mean, one.mean, rtol=1e-6)


def test_order_means_nothing():
    one, two = (FAM(random_state=0).fit(walks) for walks in (WALKS, WALKS[::-1]))
    np.testing.assert_array_equal(one.periods_, two.periods_[::-1])
    np.testing.assert_array_equal(one.offsets_, two.offsets_[::-1])
    np.testing.assert_array_equal(one.prototypes_, two.prototypes_[::-1])
    for path, again in zip(one.path_, two.path_[::-1], strict=True):
        np.testing.assert_array_equal(path, again)


def test_it_is_fitted_with_entries_missing():
    rng = np.random.default_rng(0)
    holed = [walk.hide(rng.random(walk.values.shape) < 0.3) for walk in WALKS]
    model = FAM(n_components=1, random_state=0).fit(holed)
    errors, scale = zip(
        *(
            (((p.mean - w.values)[~h.visible]) ** 2, (w.values - w.values.mean(axis=0))[~h.visible])
            for p, w, h in zip(model.impute(holed), WALKS, holed, strict=True)
        ),
        strict=True,
    )
    assert np.concatenate(errors).mean() < 0.02 * (np.concatenate(scale) ** 2).mean()


@pytest.mark.parametrize(
    "walks",
    [
        WALKS[:1],
        [_walk(str(k), n, k) for k, n in enumerate((1, 2, 5))],
        [*WALKS[:2], WALKS[2].with_values(np.ones_like(WALKS[2].values))],
        [walk.with_values(walk.values * [1, 0, 1, 0] + [0, 7, 0, 0]) for walk in WALKS[:3]],
        [WALKS[0].hide(_hidden(WALKS[0], slice(None), slice(None))), *WALKS[1:3]],
        [WALKS[0].hide(_hidden(WALKS[0], [1], slice(None))), *WALKS[1:3]],
        [walk.hide(_hidden(walk, slice(None), slice(10, 30))) for walk in WALKS[:3]],
        [walk.hide(_hidden(walk, slice(None), np.r_[0:9, 50:60])) for walk in WALKS[:3]],
    ],
    ids=[
        "a single recording",
        "recordings shorter than a cycle",
        "a recording that stands still",
        "constant channels",
        "nothing visible of a recording",
        "nothing visible of a channel of a recording",
        "nothing visible in frames",
        "gaps at both ends",
    ],
)
@pytest.mark.parametrize("n_components", [0, 3])
def test_poor_recordings_have_a_defined_result(walks, n_components):
    model = FAM(n_components=n_components, max_iter=5, random_state=0).fit(walks)
    hidden = np.zeros(walks[-1].values.shape, dtype=bool)
    hidden[len(hidden) // 2 :, [0, 1]] = True
    (prediction,) = model.impute([walks[-1].hide(hidden)])
    assert np.isfinite(prediction.mean).all()
    assert (prediction.variance[hidden] > 0).all()
    assert (np.diff(model.log_likelihood_) >= -1e-8 * np.abs(model.log_likelihood_[1:])).all()
    assert np.isfinite(model.prototypes_).all()
    assert len(model.path_) == len(model.periods_) == len(walks)


def test_a_recording_of_one_channel_is_filled():
    walks = [walk.select(["a"]) for walk in WALKS]
    model = FAM(random_state=0).fit(walks[1:])
    (prediction,) = model.impute([walks[0].hide(_hidden(walks[0], [0], slice(25, 30)))])
    np.testing.assert_allclose(prediction.mean[25:30], walks[0].values[25:30], atol=3.0)


def test_a_channel_that_nobody_shows_is_an_error():
    with pytest.raises(ValueError, match="visible entry"):
        FAM().fit([walk.hide(_hidden(walk, [2], slice(None))) for walk in WALKS])


@pytest.mark.parametrize("use", ["fit", "impute", "align"])
def test_other_channels_are_an_error(fitted, use):
    other = WALKS[0].select(CHANNELS[:3])
    act = {
        "fit": lambda: FAM().fit([WALKS[1], other]),
        "impute": lambda: fitted.impute([other]),
        "align": lambda: fitted.align([other]),
    }
    with pytest.raises(ValueError, match="expected channels"):
        act[use]()
