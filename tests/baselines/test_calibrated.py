"""A calibrated model is a model like any other, with the means of the model in it."""

import pickle
from typing import ClassVar

import numpy as np
import pytest
from fixed_variance import FixedVariance, KeepsRecordings
from sklearn.base import clone
from sklearn.exceptions import NotFittedError

from mocapbench.baselines import (
    FAM,
    GPLVM,
    HGP,
    LDS,
    MOA,
    MOHGP,
    Calibrated,
    ChannelKriging,
    CyclicAlignment,
    GPIndependent,
    LinearImputer,
    LowRank,
    Oracle,
    Prediction,
)
from mocapbench.baselines.calibration.variance_check import VarianceCheck
from mocapbench.datasets import Recording, ToyProcess

MODELS = {
    "mohgp": MOHGP(max_iter=3, n_restarts=1),
    "moa": MOA(max_iter=3),
    "hgp": HGP(max_iter=3),
    "lds": LDS(n_states=3),
    "fam": FAM(n_restarts=1, max_iter=5, random_state=0),
    "low-rank": LowRank(),
    "gplvm": GPLVM(n_latent=1, max_iter=2, fill_iter=2),
    "channel-kriging": ChannelKriging(),
    "cyclic-alignment": CyclicAlignment(n_styles=2, n_restarts=2, max_iter=3, random_state=0),
}
GAUSSIAN_PROCESSES = ("mohgp", "moa", "hgp")


def swing(name, phase, n_frames=60):
    rng, angle = np.random.default_rng(int(100 * phase)), np.arange(n_frames) / 3.0 + phase
    values = np.column_stack([np.sin(angle), 2.0 * np.cos(angle), np.sin(2.0 * angle)])
    values += 0.1 * rng.normal(size=values.shape)
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b", "c"), ("deg",) * 3)


def with_gap(recording, gap=slice(25, 32)):
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[gap] = True
    return recording.hide(hidden)


RECORDINGS = (swing("one", 0.0), swing("two", 1.3), with_gap(swing("three", 2.1)))


@pytest.fixture(scope="module", params=MODELS)
def fitted(request):
    return request.param, Calibrated(MODELS[request.param]).fit(RECORDINGS)


def same(one, other):
    np.testing.assert_array_equal(one.mean, other.mean)
    np.testing.assert_array_equal(one.variance, other.variance)


def test_means_are_those_of_the_model_and_each_channel_has_one_factor(fitted):
    name, model = fitted
    for nominal, calibrated in zip(
        model.model_.impute(RECORDINGS), model.impute(RECORDINGS), strict=True
    ):
        np.testing.assert_array_equal(calibrated.mean, nominal.mean)
        hidden = nominal.variance > 0.0
        np.testing.assert_array_equal(calibrated.variance > 0.0, hidden)
        for before, after in zip(nominal.variance.T, calibrated.variance.T, strict=True):
            factors = after[before > 0.0] / before[before > 0.0]
            if name != "lds":  # whose variances have a bound that is not a multiple of them
                np.testing.assert_allclose(factors, factors[:1].repeat(len(factors)), rtol=1e-9)


def test_some_variance_is_another_and_the_model_s_own_is_at_hand(fitted):
    name, model = fitted
    (own,), (before,) = (
        model.model_.impute(RECORDINGS[2:]),
        model.impute_uncalibrated(RECORDINGS[2:]),
    )
    same(before, own)
    if name != "cyclic-alignment":  # whose intervals are neither too narrow nor far too wide
        assert (model.impute(RECORDINGS[2:])[0].variance != own.variance).any()


def test_a_fitted_one_is_pickled(fitted):
    _, model = fitted
    same(*(one.impute(RECORDINGS[2:])[0] for one in (model, pickle.loads(pickle.dumps(model)))))


@pytest.mark.parametrize("name", MODELS)
def test_neither_order_nor_company_matters(name):
    """But for rounding, which optimisers make visible, and the first of equals."""
    orders = [RECORDINGS, RECORDINGS[::-1]]
    one, other = (Calibrated(MODELS[name]).fit(order).impute(RECORDINGS[2:])[0] for order in orders)
    np.testing.assert_allclose(one.mean, other.mean, rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(one.variance, other.variance, rtol=0.02)


def test_it_is_fitted_without_a_change_to_the_model_that_it_was_given(fitted):
    name, _ = fitted
    assert not [attribute for attribute in vars(MODELS[name]) if attribute.endswith("_")]


def test_parameters_are_those_of_a_part():
    model = Calibrated(LDS(n_states=3))
    assert model.get_params()["model__n_states"] == 3
    copy = clone(model).set_params(model__n_states=5)
    assert (copy.model.n_states, model.model.n_states) == (5, 3)
    assert copy.fit(RECORDINGS).model_.n_states_ == 5


@pytest.mark.parametrize("name", MODELS)
def test_it_says_of_itself_what_the_model_says(name):
    model, wrapper = MODELS[name], Calibrated(MODELS[name])
    for said in ("provides", "needs", "family", "max_frames"):
        assert getattr(wrapper, said) == getattr(model, said)


def test_what_the_model_needs_is_handed_on():
    process = ToyProcess.random(np.random.default_rng(0), n_outputs=2, noise=0.01)
    children = process.draw(np.random.default_rng(1), np.linspace(0.0, 6.0, 20), 3)
    assert Calibrated(Oracle()).fit(children, process=process).process_ is process


def test_what_the_model_offers_besides_is_offered():
    model = Calibrated(MODELS["mohgp"]).fit(RECORDINGS)
    times = np.linspace(0.0, 1.0, 5)
    assert model.layers == ("parent", "child")
    for one, other in zip(model.trend(times), model.model_.trend(times), strict=True):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(model.sample(times, 2, 0), model.model_.sample(times, 2, 0))
    labels = Calibrated(MODELS["cyclic-alignment"]).fit(RECORDINGS).labels_
    assert len(labels) == len(RECORDINGS)


def test_what_neither_has_is_missed_by_name():
    with pytest.raises(AttributeError, match="'LinearImputer' object has no attribute 'blend'"):
        Calibrated(LinearImputer()).blend  # noqa: B018
    assert not hasattr(Calibrated.__new__(Calibrated), "model")


def test_a_model_without_variances_is_left_as_it_is():
    model = Calibrated(LinearImputer()).fit(RECORDINGS)
    (prediction,) = model.impute(RECORDINGS[2:])
    assert prediction.variance is None


class SeldomSure(FixedVariance):
    """Predicts a variance only where it sees most frames of a recording."""

    def __init__(self, least=0.5):
        super().__init__()
        self.least = least

    def impute(self, recordings):
        predictions = zip(recordings, super().impute(recordings), strict=True)
        return [
            prediction
            if recording.visible.mean() > self.least
            else type(prediction)(prediction.mean)
            for recording, prediction in predictions
        ]


def test_recordings_without_variances_leave_others_calibrated():
    hardly = with_gap(swing("hardly", 1.0), slice(5, 50))
    one, other = Calibrated(SeldomSure()).fit(RECORDINGS).impute([hardly, RECORDINGS[2]])
    assert one.variance is None
    same(other, Calibrated(FixedVariance()).fit(RECORDINGS).impute(RECORDINGS[2:])[0])


def test_where_held_out_gaps_leave_no_variance_the_model_s_own_stays():
    (prediction,) = Calibrated(SeldomSure(least=0.85)).fit(RECORDINGS).impute(RECORDINGS[2:])
    assert RECORDINGS[2].visible.mean() > 0.85
    same(prediction, FixedVariance().impute(RECORDINGS[2:])[0])


def test_nothing_is_filled_before_it_is_fitted():
    for method in ("impute", "impute_uncalibrated"):
        with pytest.raises(NotFittedError):
            getattr(Calibrated(LinearImputer()), method)(RECORDINGS)


def test_a_model_that_keeps_recordings_is_checked_by_held_out_ones_too():
    """They err three times as far as the recording itself does."""
    training = [swing(name, 3.0).with_values(3.0 * swing(name, 3.0).values) for name in "ab"]
    alone, both = (
        Calibrated(model()).fit(training).impute(RECORDINGS[2:])[0].variance[25:32]
        for model in (FixedVariance, KeepsRecordings)
    )
    assert (both > 2.0 * alone).all()


class KeepsParameters(FixedVariance):
    """Predicts 1 with its parameters kept, and counts its fits."""

    fits: ClassVar[list[int]] = []

    def fit(self, recordings):
        self.fits.append(len(recordings))
        return self

    def impute_held_out(self, recordings):
        return [type(p)(p.mean + 1.0, p.variance) for p in self.impute(recordings)]


def test_a_model_that_predicts_held_out_gaps_itself_is_asked_and_not_fitted_again():
    KeepsParameters.fits.clear()
    model, given = Calibrated(KeepsParameters()).fit(RECORDINGS), RECORDINGS[2]
    check = VarianceCheck(given)
    held_out = KeepsParameters().impute_held_out(check.recordings())
    (prediction,) = model.impute([given])
    same(prediction, check.calibrate(KeepsParameters().impute([given])[0], held_out))
    model.impute([given.hide(np.arange(3) == np.full((60, 3), 1))])  # a lost channel
    assert KeepsParameters.fits == [3]


class LeavesOut(FixedVariance):
    """Is right of entries that are left out one by one, and errs in held-out gaps."""

    def leave_one_out(self, recordings):
        ratios = [np.where(recording.visible, 1.0, np.nan) for recording in recordings]
        return list(zip(self.impute(recordings), ratios, strict=True))

    def impute_held_out(self, recordings):
        return [Prediction(each.mean + 10.0, each.variance) for each in self.impute(recordings)]


@pytest.mark.parametrize(("length", "wider"), [(2, False), (3, True), (8, True)])
def test_gaps_of_three_frames_are_held_out_where_entries_are_left_out_one_by_one(length, wider):
    given = with_gap(swing("new", 1.0), slice(25, 25 + length))
    (prediction,) = Calibrated(LeavesOut()).fit([given]).impute([given])
    variance = prediction.variance[25]
    assert (variance > 10.0).all() if wider else (variance == 1.0).all()


CASES = {"mohgp": MOHGP(kernel="rbf", n_restarts=1, max_iter=30), "gp-independent": GPIndependent()}


@pytest.mark.parametrize("name", CASES)
def test_intervals_of_data_of_the_model_itself_hold_as_much_as_they_say(name):
    inside = []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        process = ToyProcess.random(rng, n_outputs=3, noise=0.05)
        *others, full = process.draw(rng, np.linspace(0.0, 6.0, 40), 6)
        given = full.hide(rng.random(full.values.shape) < 0.3)
        (filled,) = Calibrated(CASES[name]).fit([*others, given]).impute([given])
        within = np.abs(filled.mean - full.values) < 1.96 * np.sqrt(filled.variance)
        inside.append(within[~given.visible].mean())
    assert 0.9 < np.mean(inside) < 0.99
