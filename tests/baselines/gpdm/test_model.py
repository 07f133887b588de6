"""The estimators: what they fill, draw and refuse."""

import numpy as np
import pytest
from samples import gap

from mocapbench.baselines.gpdm.model import GPDM
from mocapbench.baselines.gpdm.starts import STARTS
from mocapbench.baselines.gplvm import GPLVM
from mocapbench.datasets import Recording

STEP = 2 * np.pi / 15.3  # so that no pose comes twice


def walk(name, start, n_frames, offset=0.0):
    """Return a cyclic motion of four channels that lie in two dimensions."""
    angle = STEP * (start + np.arange(n_frames))
    values = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1), np.cos(angle - 1)])
    channels = tuple(f"c{d}" for d in range(4))
    return Recording(name, np.arange(n_frames) / 30, values + offset, channels, ("",) * 4)


WALKS = [walk("a", 0, 25), walk("b", 4.5, 22)]


@pytest.fixture(scope="module")
def fitted():
    return GPDM(max_iter=20, n_latent=2).fit(WALKS)


def worst(prediction, truth):
    return np.abs(prediction.mean - truth.values).max()


@pytest.mark.parametrize(("first", "last"), [(8, 16), (0, 6), (14, 20)])
def test_a_gap_anywhere_in_a_new_cycle_is_filled(fitted, first, last):
    truth = walk("new", 9, 20)
    (prediction,) = fitted.impute([gap(truth, first, last)])
    assert worst(prediction, truth) < 0.25
    assert (prediction.variance[first:last] > 0).all()


@pytest.mark.parametrize(
    "learning",
    ["map", "balanced", "fixed-alpha", pytest.param("two-stage", marks=pytest.mark.slow)],
)
def test_every_way_of_learning_lowers_the_error_below_that_of_the_mean(learning):
    truth = walk("new", 9, 20)
    model = GPDM(learning, n_latent=2, max_iter=10, n_steps=5, n_samples=4, random_state=0)
    (prediction,) = model.fit(WALKS).impute([gap(truth, 8, 16)])
    error = prediction.mean - truth.values
    assert np.square(error[8:16]).mean() < 0.3 * np.square(truth.values[8:16]).mean()


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("predicts", ["position", "velocity"])
@pytest.mark.parametrize("dynamics", ["linear+rbf", "rbf", "linear"])
def test_every_dynamics_fills(dynamics, predicts, order):
    truth = walk("new", 9, 20)
    model = GPDM(n_latent=2, dynamics=dynamics, predicts=predicts, order=order, max_iter=5)
    (prediction,) = model.fit(WALKS).impute([gap(truth, 8, 16)])
    assert worst(prediction, truth) < 1.0


@pytest.mark.slow
def test_two_stage_learning_is_seeded():
    def fit(seed):
        model = GPDM("two-stage", n_latent=2, max_iter=10, n_steps=2, n_samples=3)
        return model.set_params(random_state=seed).fit(WALKS[1:]).estimate_.alpha

    np.testing.assert_array_equal(fit(1), fit(1))
    assert not np.array_equal(fit(1), fit(2))


def test_fixed_alpha_stays():
    estimate = GPDM("fixed-alpha", n_latent=2, max_iter=2).fit(WALKS).estimate_
    np.testing.assert_allclose(np.exp(estimate.alpha), [0.009, 0.2, 0.001, 1e6])


def test_kernel_properties_are_those_of_table_1(fitted):
    a1, a2, a3, a4 = np.exp(fitted.estimate_.alpha)
    b1, b2 = np.exp(fitted.estimate_.beta)
    assert fitted.kernel_properties_ == pytest.approx(
        {
            "SNR(α)": np.sqrt((a1 + a3) * a4),
            "CLS(α)": a2**-0.5,
            "SNR(β)": np.sqrt(b2),
            "CLS(β)": b1**-0.5,
        }
    )


@pytest.mark.parametrize("start", ["window", "linear"])
def test_a_training_sequence_starts_where_it_is(fitted, start):
    model, lengths = fitted.conditional_, fitted.sequences_.lengths
    query = (model.poses[: lengths[0]], np.ones(lengths[0], dtype=bool))
    np.testing.assert_allclose(STARTS[start](model, query), model.x[: lengths[0]], atol=1e-12)


def test_mean_prediction_follows_the_dynamics(fitted):
    model = fitted.conditional_
    query = (model.poses[:12], (np.arange(12) < 5) | (np.arange(12) > 8))
    x = STARTS["mean-prediction"](model, query)
    for frame in (5, 6, 7, 8):
        np.testing.assert_allclose(x[frame], model.dynamics.step(x[[frame - 1]][None])[0][0])


def test_a_window_longer_than_training_is_followed_by_the_dynamics(fitted):
    query = (np.zeros((40, 4)), np.arange(40) < 10)
    assert np.isfinite(STARTS["window"](fitted.conditional_, query)).all()


def test_the_offset_of_a_subject_is_taken_off_and_put_back(fitted):
    moved = gap(walk("new", 9, 20, offset=0.05), 8, 16)
    residual = fitted.matcher_.residual(moved)
    (there,) = fitted.impute([moved.with_values(moved.values - residual)])
    model = GPDM(max_iter=20, n_latent=2, subject_offset=1.0).fit(WALKS)
    np.testing.assert_allclose(model.impute([moved])[0].mean, there.mean + residual, atol=1e-6)


def test_new_walks_look_like_the_old(fitted):
    walks = fitted.sample(np.arange(30) / 30, 4, 0)
    assert walks.shape == (4, 30, 4)
    assert 0.2 < walks.var() / WALKS[0].values.var() < 3.0
    finer = fitted.sample(np.arange(59) / 60, 4, 0)
    np.testing.assert_allclose(finer[:, ::2], walks, atol=1e-9)


def test_latent_walks_start_with_training_and_give_poses_like_it(fitted):
    mean, samples = fitted.latent_walks(30, 3, 0)
    assert samples.shape == (3, 30, 2)
    start = fitted.latent_paths()[0][0]
    np.testing.assert_array_equal(
        np.concatenate([mean[None], samples])[:, 0], np.tile(start, (4, 1))
    )
    assert np.abs(fitted.poses(mean)).max() < 1.5


def test_confidence_is_highest_where_training_is(fitted):
    there = fitted.confidence(fitted.latent_paths()[1])
    assert there.min() > fitted.confidence(np.full((1, 2), 10.0))[0]


def test_a_constant_channel_is_left_out_with_a_warning():
    still = [
        Recording(w.name, w.times, np.column_stack([w.values, np.full(len(w.times), 7.0)]),
                  (*w.channels, "still"), ("",) * 5)
        for w in (*WALKS, walk("new", 9, 20))
    ]  # fmt: skip
    with pytest.warns(UserWarning, match="channels still, which are constant"):
        model = GPDM(max_iter=5, n_latent=2).fit(still[:2])
    (prediction,) = model.impute([gap(still[2], 8, 16)])
    assert (prediction.mean[:, 4] == 7.0).all()
    assert (prediction.variance[8:16] > 0).all()
    assert model.estimate_.scales.max() < 1e3


def test_a_latent_space_above_the_data_is_cut_with_a_warning():
    with pytest.warns(UserWarning, match="at least n_latent=5 dimensions, got 2"):
        model = GPLVM(n_latent=5, max_iter=2).fit(WALKS)
    assert model.estimate_.x.shape == (47, 2)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"learning": "sleep"}, "expected learning to be one of"),
        ({"dynamics": "cubic"}, "expected dynamics to be one of"),
        ({"predicts": "jerk"}, "expected predicts to be one of"),
        ({"order": 3}, "expected order to be 1 or 2"),
        ({"start": "middle"}, "expected start to be one of"),
        ({"subject_offset": -1.0}, "from 0 to 1"),
        ({"n_latent": 0}, "n_latent to be an integer of at least 1"),
        ({"max_iter": 2.5}, "max_iter to be an integer of at least 1"),
        ({"learning": "fixed-alpha", "order": 2}, "dynamics with 4 parameters"),
    ],
)
def test_parameters_are_validated(parameters, message):
    with pytest.raises(ValueError, match=message):
        GPDM(**{"n_latent": 2, **parameters}).fit(WALKS)


def test_what_cannot_be_filled_is_refused(fitted):
    new = walk("new", 0, 5)
    with pytest.raises(ValueError, match="'new': expected a visible frame"):
        fitted.impute([gap(new, 0, 5)])
    with pytest.raises(ValueError, match="expected channels"):
        fitted.impute([new.select(["c0"])])
    partly = new.values.copy()
    partly[2, 0] = np.nan
    with pytest.raises(ValueError, match="hidden in part"):
        fitted.impute([new.with_values(partly)])


@pytest.mark.parametrize("n_frames", [1, 2, 3])
def test_a_sequence_of_few_frames_is_filled(fitted, n_frames):
    new = walk("new", 3, n_frames)
    (prediction,) = fitted.impute([gap(new, 1, n_frames)])
    assert np.isfinite(prediction.mean).all()


def test_training_without_motion_is_refused():
    with pytest.raises(ValueError, match="two consecutive frames"):
        GPDM().fit([gap(walk("a", 0, 5), 1, 5)])
    still = walk("a", 0, 5)
    with pytest.raises(ValueError, match="a channel that moves"):
        GPDM().fit([still.with_values(np.ones((5, 4)))])
