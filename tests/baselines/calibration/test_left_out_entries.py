"""Entries left out one by one, and the variances that their errors support."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.signal import lfilter
from sklearn.exceptions import NotFittedError

from mocapbench.baselines.calibrated import Calibrated
from mocapbench.baselines.calibration.left_out_entries import leave_one_out_factors
from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.baselines.gp.solvers.planner import PLANS
from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.hgp import HGP
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording, ToyProcess

TIMES = np.linspace(0.0, 5.0, 12)
SHAPE = (12, 2)


@pytest.fixture(scope="module")
def recordings():
    rng = np.random.default_rng(0)
    *complete, last = ToyProcess.random(rng, n_outputs=2, noise=0.1).draw(rng, TIMES, 4)
    return (*complete, last.hide(rng.random(SHAPE) < 0.5))


def dense(model, shown):
    """Return mean and variance of a recording of which more is hidden, parameters kept."""
    given = {**model.recordings_, shown.name: shown}
    reduction = model.reduce(Replicates.align([model.scaling_.apply(r) for r in given.values()]))
    solvers = PLANS["dense"](KERNELS[model.kernel], reduction.blocks, model.parameters_)
    process = replace(model.process_, reduction=reduction, solvers=solvers)
    curve = reduction.replicates[list(given).index(shown.name)]
    ((mean, variance),) = process.infer([curve], [shown.times])
    return mean, variance + model.noise_


def without(model, recording, entry):
    """Return the squared error over the variance of an entry that is hidden, parameters kept."""
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[entry] = True
    mean, variance = dense(model, recording.hide(mask))
    return (recording.values[entry] - mean[entry]) ** 2 / variance[entry]


@pytest.mark.parametrize("solver", ["dense", "latent-split"])
@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_the_closed_form_is_that_of_leaving_each_entry_out(model, solver, recordings):
    fitted = model(max_iter=5, solver=solver).fit(recordings)
    for recording in recordings[2:]:
        ((_, ratios),) = fitted.leave_one_out([recording])
        np.testing.assert_array_equal(np.isfinite(ratios), recording.visible)
        expected = [without(fitted, recording, tuple(e)) for e in np.argwhere(recording.visible)]
        np.testing.assert_allclose(ratios[recording.visible], expected, rtol=1e-6)


@pytest.mark.parametrize("solver", ["dense", "latent-split", "auto"])
@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_predictions_of_held_out_gaps_are_those_of_dense_inference(model, solver, recordings):
    fitted = model(max_iter=5, solver=solver).fit(recordings)
    for number, first in ((0, 0), (3, 4), (3, 8)):
        mask = np.zeros(SHAPE, dtype=bool)
        mask[first : first + 4] = True
        shown = recordings[number].hide(mask)
        (held_out,), (mean, variance) = fitted.impute_held_out([shown]), dense(fitted, shown)
        hidden = ~shown.visible
        np.testing.assert_allclose(held_out.mean[hidden], mean[hidden], rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(held_out.variance[hidden], variance[hidden], rtol=1e-6)
        np.testing.assert_array_equal(held_out.mean[~hidden], shown.values[~hidden])


@pytest.mark.parametrize("model", [GPIndependent, HGP])
def test_channels_side_by_side_have_their_own_errors(model, recordings):
    fitted = model(max_iter=5).fit(recordings)
    ((_, ratios),) = fitted.leave_one_out(recordings[3:])
    for column, channel, single in zip(
        ratios.T, recordings[3].channels, fitted.models_, strict=True
    ):
        ((_, alone),) = single.leave_one_out([recordings[3].select([channel])])
        np.testing.assert_array_equal(column, alone[:, 0])


def test_held_out_gaps_need_not_be_shared_by_all_outputs(recordings):
    """The solver of `fit` may: the Kronecker one has the same frames of all outputs hidden."""
    hidden = np.indices(SHAPE)[0] // 4 == 1
    given = [recording.hide(hidden) for recording in recordings[:3]]
    fitted = MOA(max_iter=5, solver="kronecker").fit(given)
    shown = given[0].hide(np.arange(24).reshape(SHAPE) == 18)
    (held_out,), (mean, variance) = fitted.impute_held_out([shown]), dense(fitted, shown)
    np.testing.assert_allclose(held_out.mean[9, 0], mean[9, 0], rtol=1e-6)
    np.testing.assert_allclose(held_out.variance[9, 0], variance[9, 0], rtol=1e-6)


def test_held_out_gaps_take_the_kernel_that_was_fitted(recordings):
    fitted = MOHGP(max_iter=3).fit(recordings)
    shown = recordings[0].hide(np.indices(SHAPE)[0] // 4 == 1)
    (before,) = fitted.impute_held_out([shown])
    (after,) = fitted.set_params(kernel="rbf").impute_held_out([shown])
    np.testing.assert_array_equal(after.variance, before.variance)


def test_gaps_are_held_out_of_recordings_given_to_fit(recordings):
    shown = recordings[0].hide(np.indices(SHAPE)[0] // 4 == 1)
    with pytest.raises(NotFittedError):
        MOHGP().impute_held_out([shown])
    fitted = MOHGP(max_iter=2).fit(recordings)
    with pytest.raises(ValueError, match="expected recordings that were given to fit"):
        fitted.impute_held_out([replace(shown, name="another")])


@pytest.mark.parametrize("model", [GPIndependent, HGP])
def test_channels_side_by_side_have_their_own_held_out_gaps(model, recordings):
    fitted = model(max_iter=5).fit(recordings)
    shown = recordings[0].hide(np.indices(SHAPE)[0] // 4 == 1)
    (held_out,) = fitted.impute_held_out([shown])
    for d, (channel, single) in enumerate(zip(shown.channels, fitted.models_, strict=True)):
        (alone,) = single.impute_held_out([shown.select([channel])])
        np.testing.assert_array_equal(held_out.mean[:, [d]], alone.mean)
        np.testing.assert_array_equal(held_out.variance[:, [d]], alone.variance)


def test_entries_of_which_rounding_may_decide_do_not_count(recordings):
    """With less noise, the posterior variance of an entry that is far from others is the noise."""
    walks = [r.with_values(np.cumsum(r.values, axis=0)) for r in recordings[:3]]
    given = walks[0].hide(np.indices(SHAPE).sum(axis=0) % 4 == 1)
    model = MOHGP(max_iter=40, solver="latent-split").fit((given, *walks[1:]))
    little = replace(model.parameters_, log_noise=np.log([5e-5, 1e-2]))
    model.parameters_, model.process_ = little, replace(model.process_, parameters=little)
    ((_, ratios),) = model.leave_one_out([given])
    counted = np.isfinite(ratios)
    seen = given.visible
    assert counted[:, 1][seen[:, 1]].all()
    assert 0 < counted[:, 0].sum() < seen[:, 0].sum()
    expected = [without(model, given, tuple(entry)) for entry in np.argwhere(counted)]
    np.testing.assert_allclose(ratios[counted], expected, rtol=0.02)


@given(
    ratios=arrays(np.float64, SHAPE, elements=st.floats(0.0, 9.0)),
    seen=arrays(np.bool_, SHAPE),
)
def test_variances_follow_the_mean_square(ratios, seen):
    """Of a channel, and never below that of all, in which 200 entries of ratio 1 count.

    The mean over all channels counts as ten entries in each.
    """
    factors = leave_one_out_factors(seen, np.where(seen, ratios, np.nan))
    if not seen.any():
        np.testing.assert_array_equal(factors, 1.0)
        return
    pooled = ratios[seen].mean()
    of_all = (ratios[seen].sum() + 200.0) / (seen.sum() + 200.0)
    for channel in range(SHAPE[1]):
        own = ratios[seen[:, channel], channel]
        farther = mean_distance(seen[:, channel], ~seen[:, channel])
        farther /= mean_distance(seen[:, channel], seen[:, channel])
        least = min(of_all * max(farther, 1.0) ** 0.6, 1.0) if len(own) > 1 else 1.0
        factor = max(least, (own.sum() + 10.0 * pooled) / (len(own) + 10.0))
        np.testing.assert_allclose(factors[channel], factor)


def mean_distance(visible, entries):
    """Return how many frames entries of a channel are from the nearest other visible one."""
    distances = [
        np.abs(np.setdiff1d(np.flatnonzero(visible), [frame]) - frame).min(initial=10**9)
        for frame in np.flatnonzero(entries)
    ]
    return np.mean(distances or [0.0])


def test_entries_of_other_channels_say_nothing_of_one_that_is_hidden_throughout():
    ratios = np.full((100, 3), 0.25)
    ratios[:, 0], ratios[50, 1] = np.nan, np.nan
    factors = leave_one_out_factors(~np.isnan(ratios), ratios)
    assert factors[0] == 1.0
    assert (factors[1:] < 1.0).all()


def test_entries_between_visible_ones_say_less_of_longer_gaps():
    """Most of 4,000 visible entries are far better predicted than their variances say."""
    hidden = np.zeros((100, 50), dtype=bool)
    hidden[40:60] = True
    ratios = np.where(hidden, np.nan, 0.25)
    long, short = (
        leave_one_out_factors(~mask, ratios)
        for mask in (hidden, hidden & (np.arange(100)[:, None] == 50))
    )
    assert (short < 0.5).all()
    # Hidden entries are 1 to 10 frames from visible ones, those left out 1.
    np.testing.assert_allclose(long, short * 5.5**0.6)


def test_complete_recordings_have_no_variance_though_they_have_moved(recordings):
    model = Calibrated(MOHGP(registration="affine", max_iter=3)).fit(recordings)
    for recording, prediction in zip(recordings[:3], model.impute(recordings[:3]), strict=True):
        np.testing.assert_array_equal(prediction.mean, recording.values)
        assert (prediction.variance == 0.0).all()


def test_a_recording_unlike_the_others_gets_wider_intervals():
    """One deviates four times as far as the model has learnt of the many that do not."""
    rng, times = np.random.default_rng(2), np.linspace(0.0, 5.0, 40)
    covered = []
    for _ in range(5):
        *usual, odd = ToyProcess.random(rng, n_outputs=3, noise=0.01).draw(rng, times, 9)
        mean = np.mean([recording.values for recording in usual], axis=0)
        odd = odd.with_values(mean + 4.0 * (odd.values - mean))
        given = odd.hide(rng.random((40, 3)) < 0.6)
        model = Calibrated(MOHGP(kernel="rbf", max_iter=30)).fit((*usual, given))
        covered.append(
            [
                np.mean(((p.mean - odd.values) ** 2 < 1.96**2 * p.variance)[~given.visible])
                for p in (*model.model_.impute([given]), *model.impute([given]))
            ]
        )
    nominal, calibrated = np.mean(covered, axis=0)
    assert nominal < 0.9 < calibrated


def test_gaps_are_held_out_where_entries_left_out_one_by_one_say_little():
    """One recording wanders off by steps as large as those by which the others stay about 0."""
    rng, shape, hidden = np.random.default_rng(3), (200, 2), np.zeros((200, 2), dtype=bool)
    hidden[80:120] = True

    def recording(name, pull):
        values = lfilter([1.0], [1.0, pull - 1.0], rng.normal(size=shape), axis=0)
        return Recording(name, np.arange(200) / 30, values, ("a", "b"), ("", ""))

    covered = []
    for _ in range(5):
        full = recording("wandering", 0.0)
        others = [recording(f"staying {number}", 0.3) for number in range(6)]
        given = full.hide(hidden)
        model = Calibrated(GPIndependent(kernel="matern12", max_iter=20)).fit((*others, given))
        ((_, ratios),), (filled,) = model.leave_one_out([given]), model.impute([given])
        (nominal,), factors = model.model_.impute([given]), leave_one_out_factors(~hidden, ratios)
        one_by_one = replace(nominal, variance=nominal.variance * factors)
        np.testing.assert_array_equal(filled.mean, one_by_one.mean)
        assert (filled.variance >= one_by_one.variance).all()
        within = [abs(p.mean - full.values) < 1.96 * p.variance**0.5 for p in (one_by_one, filled)]
        covered.append([inside[hidden].mean() for inside in within])
    one_by_one, calibrated = np.mean(covered, axis=0)
    assert one_by_one < 0.8
    assert calibrated > 0.85


def test_what_is_predicted_beside_left_out_entries_is_the_posterior(recordings):
    fitted = MOHGP(max_iter=5).fit(recordings)
    ((prediction, _),), (posterior,) = (
        answer([recordings[3]]) for answer in (fitted.leave_one_out, fitted.impute)
    )
    np.testing.assert_array_equal(prediction.mean, posterior.mean)
    np.testing.assert_array_equal(prediction.variance, posterior.variance)
