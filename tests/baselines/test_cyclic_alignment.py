from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.cyclic_alignment import CyclicAlignment
from mocapbench.datasets import Recording

QUICK = {"n_styles": 2, "max_iter": 15, "random_state": 0, "refine_iter": 3}
CHANNELS = ("a", "b", "c", "d")
PHASES = np.array([0.0, 0.7, 1.9, 4.0])


def _recording(name, values):
    return Recording(name, np.arange(len(values)) / 30.0, values, CHANNELS, ("deg",) * 4)


def _walk(name, style, n_frames=50, seed=0, *, pace=1.0, noise=0.05):
    """A walk of 12 frames a cycle at pace 1; style 1 swings the other way, at half the size."""
    rng = np.random.default_rng(seed)
    phase = 2.0 * np.pi * (np.arange(n_frames) * pace / 12.0 + rng.random())
    swing = (1.0, 0.5)[style] * np.sin(phase[:, None] * np.array([1, 1, 2, 1]) + PHASES)
    poses = 10.0 * swing + np.array([0.0, 30.0 * style, -5.0, 100.0])
    return _recording(name, poses + 10.0 * noise * rng.normal(size=poses.shape))


WALKS = tuple(_walk(f"walk-{k}", k % 2, 40 + 3 * k, k, pace=0.9 + 0.04 * k) for k in range(6))
RENAMED = tuple(replace(walk, name=f"new {walk.name}") for walk in WALKS)


@pytest.fixture(scope="module")
def fitted():
    return CyclicAlignment(n_restarts=2, **QUICK).fit(WALKS)


def _hidden(recording, channels, start=20):
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[start:, channels] = True
    return mask


def test_styles_are_told_apart(fitted):
    assert len(set(fitted.labels_[::2])) == len(set(fitted.labels_[1::2])) == 1
    assert fitted.labels_[0] != fitted.labels_[1]


def test_the_bound_is_traced_and_the_best_restart_kept(fitted):
    assert (np.diff(fitted.bound_) >= -1e-9 * np.abs(fitted.bound_[1:])).all()
    assert len(fitted.bound_) == fitted.n_iterations_ + 1
    assert fitted.bound_[-1] == fitted.restart_bounds_.max()
    assert len(fitted.restart_bounds_) == 2


def test_a_cycle_has_two_states_a_frame_of_it(fitted):
    assert abs(fitted.cycle_length_ - 24) <= 2
    assert fitted.cycles_.shape == (2, fitted.cycle_length_, 4)


def test_paths_go_round_by_one_to_three_states_a_frame(fitted):
    for path, walk in zip(fitted.path_, WALKS, strict=True):
        steps = np.diff(path) % fitted.cycle_length_
        assert path.shape == walk.times.shape
        assert ((steps >= 1) & (steps <= 3)).all()


def test_aligned_frames_resemble_their_states(fitted):
    for path, style, walk in zip(fitted.path_, fitted.labels_, WALKS, strict=True):
        error = walk.values - fitted.cycles_[style][path]
        assert np.sqrt((error**2).mean()) < 2.0


def test_a_new_recording_aligns_as_if_fitted(fitted):
    for path, again in zip(fitted.path_, fitted.align(RENAMED), strict=True):
        distance = np.abs(path - again)
        assert (np.minimum(distance, fitted.cycle_length_ - distance) <= 1).mean() > 0.9


@pytest.mark.parametrize("channels", [[0], [1, 2], [0, 1, 2, 3]])
def test_hidden_entries_of_a_new_walk_are_filled(fitted, channels):
    new = _walk("new", 1, 50, 99)
    mask = _hidden(new, channels)
    mask[30:] &= len(channels) < 4  # whole frames are a gap, not an end
    (prediction,) = fitted.impute([new.hide(mask)])
    error = (prediction.mean - new.values)[mask]
    assert np.sqrt((error**2).mean()) < 2.0
    standardised = error / np.sqrt(prediction.variance[mask])
    assert (np.abs(standardised) < 4.0).all()


def test_a_recording_seen_in_fit_is_taken_as_it_is_given_now(fitted):
    mask = _hidden(WALKS[2], [0, 1])
    (prediction,) = fitted.impute([WALKS[2].hide(mask)])
    assert not np.allclose(prediction.mean[mask], WALKS[2].values[mask], atol=1e-6)
    assert np.abs((prediction.mean - WALKS[2].values)[mask]).mean() < 2.0


def test_a_filled_recording_is_the_mixture_over_runs():
    model = CyclicAlignment(**{**QUICK, "max_iter": 4}, n_restarts=3).fit(WALKS)
    given = WALKS[0].hide(_hidden(WALKS[0], [0, 2]))
    (mixture,), (held_out,) = model.impute([given]), model.impute_held_out([given])
    runs, single = model.runs_, []
    for run in runs:
        model.runs_ = [run]
        single += model.impute([given])
    mean = np.mean([s.mean for s in single], axis=0)
    second = np.mean([s.variance + s.mean**2 for s in single], axis=0)
    np.testing.assert_allclose(mixture.mean, mean)
    np.testing.assert_allclose(mixture.variance, second - mean**2, atol=1e-6)
    best = single[int(model.restart_bounds_.argmax())]
    np.testing.assert_array_equal(held_out.mean, best.mean)
    np.testing.assert_array_equal(held_out.variance, best.variance)


def test_units_mean_nothing():
    factor, offset = np.array([1e-3, 1.0, 50.0, 7.0]), np.array([5.0, 0.0, -1e3, 2.0])
    other = [walk.with_values(walk.values * factor + offset) for walk in WALKS]
    mask = _hidden(WALKS[0], [0, 2])
    one, two = (
        CyclicAlignment(**QUICK).fit(walks).impute([walks[0].hide(mask)])[0]
        for walks in (WALKS, other)
    )
    np.testing.assert_allclose(two.mean, one.mean * factor + offset, rtol=1e-5)
    np.testing.assert_allclose(two.variance, one.variance * factor**2, rtol=1e-4)


def test_order_means_nothing(fitted):
    turned = CyclicAlignment(n_restarts=2, **QUICK).fit(WALKS[::-1])
    np.testing.assert_array_equal(turned.labels_, fitted.labels_[::-1])
    np.testing.assert_array_equal(turned.bound_, fitted.bound_)


def test_samples_look_like_a_walk_of_any_length(fitted):
    draws = fitted.sample(np.arange(100) / 30.0, 20, 0)
    stacked = np.concatenate([walk.values for walk in WALKS])
    assert draws.shape == (20, 100, 4)
    ratio = draws.reshape(-1, 4).std(axis=0) / stacked.std(axis=0)
    assert ((ratio > 0.7) & (ratio < 1.4)).all()
    assert fitted.sample(np.zeros(1), 2, 0).shape == (2, 1, 4)


def test_a_blend_lies_between_the_styles_that_it_mixes(fitted):
    pure = [fitted.blend(np.tile(row, (30, 1))) for row in np.eye(2)]
    share = np.linspace(0.0, 1.0, 30)[:, None]
    mixed = fitted.blend(np.hstack([1.0 - share, share]))
    np.testing.assert_allclose(mixed, (1.0 - share) * pure[0] + share * pure[1])


def test_a_style_by_itself_is_its_cycle_at_the_mean_pace(fitted):
    jumps = fitted.state_.jumps.mean(axis=0)
    position = np.arange(30) * (jumps @ [1, 2, 3])
    n_states = fitted.cycle_length_
    for style, cycle in enumerate(fitted.cycles_):
        motion = fitted.blend(np.tile(np.eye(2)[style], (30, 1)))
        expected = [
            np.interp(position, np.arange(n_states), column, period=n_states) for column in cycle.T
        ]
        np.testing.assert_allclose(motion, np.column_stack(expected))


@pytest.mark.parametrize("weights", [np.ones((5, 3)), np.full((5, 2), 0.6), [[1.5, -0.5]]])
def test_weights_that_are_none_are_refused(fitted, weights):
    with pytest.raises(ValueError, match="weights"):
        fitted.blend(weights)


def _all_hidden(walk, *, frames=slice(None), channels=slice(None)):
    mask = np.zeros(walk.values.shape, dtype=bool)
    mask[frames, channels] = True
    return walk.hide(mask)


@pytest.mark.parametrize(
    "walks",
    [
        WALKS[:1],
        [_walk(str(k), 0, n, k) for k, n in enumerate((1, 2, 5))],
        [*WALKS[:2], WALKS[2].with_values(np.ones_like(WALKS[2].values))],
        [walk.with_values(walk.values * [1, 0, 1, 0] + [0, 7, 0, 0]) for walk in WALKS[:3]],
        [_all_hidden(WALKS[0]), *WALKS[1:3]],
        [_all_hidden(WALKS[0], channels=[1]), *WALKS[1:3]],
        [_all_hidden(walk, frames=slice(10, 30)) for walk in WALKS[:3]],
    ],
    ids=[
        "a single sequence",
        "sequences shorter than a cycle",
        "a sequence that stands still",
        "constant channels",
        "nothing visible of a sequence",
        "nothing visible of a channel of a sequence",
        "nothing visible in frames",
    ],
)
@pytest.mark.parametrize("n_styles", [1, 4])
def test_poor_recordings_have_a_defined_result(walks, n_styles):
    model = CyclicAlignment(**{**QUICK, "n_styles": n_styles, "max_iter": 5}).fit(walks)
    hidden = np.zeros(walks[-1].values.shape, dtype=bool)
    hidden[len(hidden) // 2 :, [0, 1]] = True
    (prediction,) = model.impute([walks[-1].hide(hidden)])
    assert np.isfinite(prediction.mean).all()
    assert (prediction.variance[hidden] > 0).all()
    assert (np.diff(model.bound_) >= -1e-9 * np.abs(model.bound_[1:])).all()
    assert len(model.labels_) == len(model.path_) == len(walks)


def test_a_channel_that_nobody_shows_is_an_error():
    with pytest.raises(ValueError, match="visible entry"):
        CyclicAlignment(**QUICK).fit([_all_hidden(walk, channels=[2]) for walk in WALKS])


@pytest.mark.parametrize("use", ["fit", "impute", "align"])
def test_other_channels_are_an_error(fitted, use):
    other = WALKS[0].select(CHANNELS[:3])
    act = {
        "fit": lambda: CyclicAlignment(**QUICK).fit([WALKS[1], other]),
        "impute": lambda: fitted.impute([other]),
        "align": lambda: fitted.align([other]),
    }
    with pytest.raises(ValueError, match="expected channels"):
        act[use]()
