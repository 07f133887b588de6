"""Entries left out one by one, and variances that their errors bear out."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.baselines.gp.left_out import LeftOut
from mocapbench.baselines.gp.planner import PLANS
from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.hgp import HGP
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.protocols import Prediction
from mocapbench.datasets import ToyProcess

TIMES = np.linspace(0.0, 5.0, 12)
SHAPE = (12, 2)


@pytest.fixture(scope="module")
def recordings():
    rng = np.random.default_rng(0)
    *complete, last = ToyProcess.random(rng, n_outputs=2, noise=0.1).draw(rng, TIMES, 4)
    return (*complete, last.hide(rng.random(SHAPE) < 0.5))


def without(model, recording, entry):
    """Return the squared error over the variance of an entry that is hidden, parameters kept."""
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[entry] = True
    given = {**model.recordings_, recording.name: recording.hide(mask)}
    reduction = model.reduce(Replicates.align([model.scaling_.apply(r) for r in given.values()]))
    solvers = PLANS["dense"](KERNELS[model.kernel], reduction, model.parameters_)
    process = replace(model._process, reduction=reduction, solvers=solvers)
    curve = reduction.replicates[list(given).index(recording.name)]
    ((mean, variance),) = process.infer([curve], [recording.times])
    return (recording.values[entry] - mean[entry]) ** 2 / (variance + model.noise_)[entry]


@pytest.mark.parametrize("solver", ["dense", "latent-split"])
@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_the_closed_form_is_that_of_leaving_each_entry_out(model, solver, recordings):
    fitted = model(max_iter=5, solver=solver).fit(recordings)
    for recording in recordings[2:]:
        (errors,) = fitted.left_out([recording])
        np.testing.assert_array_equal(np.isfinite(errors.squares), recording.visible)
        expected = [without(fitted, recording, tuple(e)) for e in np.argwhere(recording.visible)]
        np.testing.assert_allclose(errors.squares[recording.visible], expected, rtol=1e-6)


@pytest.mark.parametrize("model", [GPIndependent, HGP])
def test_channels_side_by_side_have_their_own_errors(model, recordings):
    fitted = model(max_iter=5).fit(recordings)
    (errors,) = fitted.left_out(recordings[3:])
    for column, channel, single in zip(
        errors.squares.T, recordings[3].channels, fitted.models_, strict=True
    ):
        (alone,) = single.left_out([recordings[3].select([channel])])
        np.testing.assert_array_equal(column, alone.squares[:, 0])


def test_entries_of_which_rounding_may_decide_do_not_count(recordings):
    """With less noise, the posterior variance of an entry that is far from others is the noise."""
    walks = [r.with_values(np.cumsum(r.values, axis=0)) for r in recordings[:3]]
    given = walks[0].hide(np.indices(SHAPE).sum(axis=0) % 4 == 1)
    model = MOHGP(max_iter=40, solver="latent-split").fit((given, *walks[1:]))
    little = replace(model.parameters_, log_noise=np.log([5e-5, 1e-2]))
    model.parameters_, model._process = little, replace(model._process, parameters=little)
    (errors,) = model.left_out([given])
    counted = np.isfinite(errors.squares)
    seen = given.visible
    assert counted[:, 1][seen[:, 1]].all()
    assert 0 < counted[:, 0].sum() < seen[:, 0].sum()
    expected = [without(model, given, tuple(entry)) for entry in np.argwhere(counted)]
    np.testing.assert_allclose(errors.squares[counted], expected, rtol=0.02)


@given(
    squares=arrays(np.float64, SHAPE, elements=st.floats(0.0, 9.0)),
    seen=arrays(np.bool_, SHAPE),
)
def test_variances_grow_by_the_mean_square_and_never_shrink(squares, seen):
    """The mean over all channels counts as ten entries in each."""
    claimed = Prediction(np.ones(SHAPE), np.full(SHAPE, 2.0))
    widened = LeftOut(claimed, np.where(seen, squares, np.nan)).widened()
    np.testing.assert_array_equal(widened.mean, claimed.mean)
    pooled = squares[seen].mean() if seen.any() else 1.0
    for channel in range(SHAPE[1]):
        own = squares[seen[:, channel], channel]
        factor = max(1.0, (own.sum() + 10.0 * pooled) / (len(own) + 10.0))
        np.testing.assert_allclose(widened.variance[:, channel], 2.0 * factor)


def test_complete_recordings_have_nothing_to_widen_though_they_have_moved(recordings):
    model = MOHGP(registration="affine", max_iter=3).fit(recordings)
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
        model = MOHGP(kernel="rbf", max_iter=30).fit((*usual, given))
        covered.append(
            [
                np.mean(((p.mean - odd.values) ** 2 < 1.96**2 * p.variance)[~given.visible])
                for p in (*model.as_claimed([given]), *model.impute([given]))
            ]
        )
    claimed, widened = np.mean(covered, axis=0)
    assert claimed < 0.9 < widened
