"""What fills a recording: the same bits wherever, and for each kind of gap its own model."""

from dataclasses import replace

import numpy as np
import pytest
from fill_workers import Here
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import Imputer, LinearImputer, Prediction
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling import filled_recording
from mocapbench.benchmark.filling.choosing import choice, halving, hold_outs
from mocapbench.benchmark.filling.choosing.kinds import tell_kinds
from mocapbench.benchmark.filling.filled_recording import fill, require_fillable
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest, NamedEntries, select
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import Recording

SPEEDS = {"hip.rx": 1.0, "hip.ry": 1.3, "knee.rx": 2.0, "root.tx": 0.7, "root.ty": 0.5}
UNITS = {"hip.rx": "deg", "hip.ry": "deg", "knee.rx": "deg", "root.tx": "cm", "root.ty": "cm"}
N_FRAMES = 160


def make_waves(channels=tuple(SPEEDS), name="waves", phase=0.0):
    times = np.arange(N_FRAMES) / 50
    curves = [20 * np.sin(6 * SPEEDS[channel] * times + phase) for channel in channels]
    return Recording(name, times, np.column_stack(curves), channels, [UNITS[c] for c in channels])


def make_mask(*gaps, channels=tuple(SPEEDS)):
    mask = np.zeros((N_FRAMES, len(channels)), dtype=bool)
    for start, stop, hidden in gaps:
        mask[start:stop, [channels.index(channel) for channel in hidden]] = True
    return mask


def ask(recording, mask, train=(), models=BEST):
    named = np.full(int(mask.sum()), models) if isinstance(models, str) else models
    return FillRequest(recording.hide(mask), mask, named, tuple(train))


def fill_here(request, workers=None, effort="normal"):
    return fill(request, workers or Here(), effort, lambda *_: None)


class Draws(Imputer):
    """Adds what it draws at random, in the order of channels, to the mean of what it has learnt."""

    def __init__(self, random_state=None):
        self.random_state = random_state

    def fit(self, recordings):
        draws = np.random.default_rng(self.random_state)
        values = [np.nanmean(one.values, axis=0) for one in recordings]
        self.means_ = sum(draws.normal() * value for value in values) + draws.normal(
            size=len(recordings[0].channels)
        )
        return self

    def impute(self, recordings):
        return [Prediction.around(one, self.means_, 4.0) for one in recordings]


class Exact(Imputer):
    """Knows the waves, and is wrong by 1 to 2 where it is not ``right``."""

    variance = None

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(one, self.predict(one), self.variance) for one in recordings]

    def predict(self, recording):
        waves = [20 * np.sin(6 * SPEEDS[name] * recording.times) for name in recording.channels]
        wrong = 1.5 + np.sin(37 * recording.times[:, None]) / 2
        return np.column_stack(waves) + np.where(self.right(recording), 0.0, wrong)


class ExactAngles(Exact):
    """Right about angles."""

    variance = 9.0

    def right(self, recording):
        return np.array(recording.units) == "deg"


class ExactPlaces(Exact):
    """Right about places."""

    def right(self, recording):
        return np.array(recording.units) == "cm"


class ExactShort(Exact):
    """Right in gaps of less than a quarter of a second."""

    def right(self, recording):
        return ~find_long(recording)


class ExactLong(Exact):
    """Right in longer gaps."""

    def right(self, recording):
        return find_long(recording)


def find_long(recording):
    long = np.zeros(recording.values.shape, dtype=bool)
    for channel, column in enumerate(recording.visible.T):
        for start, stop in run_bounds(~column).tolist():
            long[start:stop, channel] = stop - start > 12
    return long


OWN = {
    "draws": Draws,
    "exact-angles": ExactAngles,
    "exact-places": ExactPlaces,
    "exact-short": ExactShort,
    "exact-long": ExactLong,
}


@pytest.fixture
def only(monkeypatch):
    """Return a function that leaves a few models to choose from, which take little work."""
    for module in (choice, halving):
        monkeypatch.setattr(module, "predict_seconds", lambda *_: 0.01)
    monkeypatch.setattr(choice, "predict_calibrated_seconds", lambda *_: 0.03)
    monkeypatch.setattr(hold_outs, "MOST_HOLD_OUTS", 4)
    for name, model in OWN.items():
        MODELS.add(name, model)
    return lambda *names: monkeypatch.setattr(choice, "find_candidates", lambda _: names)


GAPS = (
    (10, 16, ["hip.rx"]),
    (30, 50, ["knee.rx", "hip.ry"]),
    (70, 90, ["root.tx", "root.ty"]),
    (120, 125, ["root.tx", "root.ty", "hip.rx"]),
)


def tabulate(filled):
    """Return what filled each entry, by its frame and the name of its channel, to the bit."""
    frames, channels = np.nonzero(filled.request.target)
    names = np.array(filled.request.given.channels)[channels]
    kinds = [filled.all_kinds[kind] for kind in filled.kinds]
    means, deviations = (values.tolist() for values in (filled.prediction.mean, filled.std))
    rows = zip(means, map(str, deviations), filled.models.tolist(), kinds, strict=True)
    return dict(zip(zip(frames.tolist(), names.tolist(), strict=True), rows, strict=True))


def make_request(channels=tuple(SPEEDS), trained=(0, 1, 2), names="abcd", models=BEST):
    """Return one request, but for the order of its channels and files, and names."""
    train = [make_waves(channels, names[1 + n], phase=1.0 + n) for n in trained]
    mask = make_mask(*GAPS, channels=channels)
    return ask(make_waves(channels, names[0]), mask, train, models)


NAMES = st.lists(st.text(min_size=1, max_size=5), min_size=4, max_size=4, unique=True)


def test_the_same_bits_fill_whatever_the_order_the_names_and_how_quick_workers_are(only):
    only("linear", "pca-regression", "exact-angles", "draws")
    expected = fill_here(make_request())
    assert len({*expected.models}) > 1

    @settings(deadline=None, max_examples=5)
    @given(
        st.permutations(list(SPEEDS)),
        st.permutations(range(3)),
        NAMES,
        st.randoms(use_true_random=False),
    )
    def check(channels, trained, names, rng):
        request = make_request(tuple(channels), trained, names)
        assert tabulate(fill_here(request, Here(rng=rng))) == tabulate(expected)

    check()


def test_models_that_draw_fill_the_same_bits_whatever_the_order(only):
    only("draws")
    channels = tuple(SPEEDS)[::-1]
    one, other = fill_here(make_request()), fill_here(make_request(channels, (2, 0, 1), "zyxw"))
    assert tabulate(one) == tabulate(other)
    assert tabulate(fill_here(make_request(), Here(seed=1))) != tabulate(one)


@pytest.mark.slow
def test_the_same_bits_fill_by_one_worker_and_by_two(monkeypatch):
    models = ("linear", "pchip", "pca-regression", "low-rank")
    monkeypatch.setattr(choice, "find_candidates", lambda _: models)
    found = []
    for count in (1, 2):
        with Workers(count) as workers:
            found.append(tabulate(fill_here(make_request(), workers)))
    assert found[0] == found[1] == tabulate(fill_here(make_request()))


def test_each_kind_of_gap_is_filled_by_the_model_that_is_exact_for_it(only):
    only("linear", "exact-angles", "exact-places")
    mask = make_mask(*GAPS)
    filled = fill_here(ask(make_waves(), mask))
    np.testing.assert_allclose(filled.recording.values, make_waves().values, atol=1e-12)
    units = np.array(make_waves().units)[np.nonzero(mask)[1]]
    assert {*filled.models[units == "deg"]} == {"exact-angles"}
    assert {*filled.models[units == "cm"]} == {"exact-places"}
    np.testing.assert_array_equal(filled.std, np.where(units == "deg", 3.0, np.nan))
    assert {*filled.used} == {"exact-angles", "exact-places"}


def test_short_and_long_gaps_are_filled_by_the_models_that_are_exact_for_them(only):
    only("linear", "exact-short", "exact-long")
    mask = make_mask((20, 26, ["hip.rx"]), (60, 80, ["hip.rx"]))
    filled = fill_here(ask(make_waves(), mask))
    assert filled.models.tolist() == ["exact-short"] * 6 + ["exact-long"] * 20
    np.testing.assert_allclose(filled.recording.values, make_waves().values, atol=1e-12)
    assert np.isnan(filled.std).all()
    assert filled.prediction.variance is None


def test_kinds_are_those_of_the_gaps_of_each_entry(only):
    only("linear")
    request = make_request()
    filled = fill_here(request)
    numbers = np.full(request.target.shape, -1)
    numbers[request.target] = filled.kinds
    told = tell_kinds(request.problem)
    for gap, kinds in told.items():
        for kind, channels in kinds.items():
            entries = numbers[gap.start : gap.stop, list(channels)]
            assert {filled.all_kinds[k] for k in entries.ravel()} == {kind}
    assert {*filled.all_kinds} == {kind for kinds in told.values() for kind in kinds}


@pytest.mark.parametrize("gap", GAPS, ids=str)
def test_a_named_model_fills_what_it_is_named_for_and_changes_no_other_bit(only, gap):
    only("linear", "pca-regression", "draws")
    request = make_request()
    named = make_mask(gap)[request.target]
    models = np.where(named, "makima", BEST)
    before, after = fill_here(request), fill_here(replace(request, models=models))
    assert {*after.models[named]} == {"makima"}
    alone = fill_here(replace(request, models=np.full(len(models), "makima")))
    assert alone.choice is None
    np.testing.assert_array_equal(after.prediction.mean[named], alone.prediction.mean[named])
    for one in (lambda f: f.prediction.mean, lambda f: f.std, lambda f: f.models):
        np.testing.assert_array_equal(one(after)[~named], one(before)[~named])


def test_a_named_model_is_run_alone(only):
    only("linear", "draws")
    workers = Here()
    filled = fill_here(make_request(models="linear"), workers)
    assert [(model, method) for model, *_, method in workers.submitted] == [("linear", "impute")]
    assert {*filled.models} == {"linear"}


def test_a_named_model_that_cannot_fill_these_gaps_is_refused(only):
    request = make_request(models="aligned-window")
    for refuse in (lambda: fill_here(request), lambda: require_fillable(request, 0)):
        with pytest.raises(UsageError, match="expected a model that fills frames of which some"):
            refuse()


def test_room_is_looked_for_in_the_problem_that_is_filled(monkeypatch):
    """Which gaps are tried first depends on the order of channels, and so may the room."""
    looked = []
    monkeypatch.setattr(filled_recording, "require_room", lambda one, seed: looked.append(one))
    for channels in (tuple(SPEEDS), tuple(SPEEDS)[::-1]):
        require_fillable(make_request(channels), 0)
    assert looked[0].given.channels == looked[1].given.channels


def test_intervals_are_calibrated_unless_that_takes_more_work_than_is_allowed(only, monkeypatch):
    """A chosen model then fills uncalibrated, and one that is named is calibrated at any price."""
    only("linear")
    for seconds, method in ((0.1, "impute"), (1e9, "impute_uncalibrated")):
        monkeypatch.setattr(
            filled_recording, "predict_calibrated_seconds", lambda *_, seconds=seconds: seconds
        )
        workers = Here()
        fill_here(make_request(), workers)
        assert workers.submitted[-1][-1] == method
        fill_here(make_request(models="linear"), workers)
        assert workers.submitted[-1][-1] == "impute"


class FailsOnTheFile(Here):
    """Calibrated fits fail, of which the file takes one and a check of intervals more."""

    def __init__(self, *failing):
        super().__init__()
        self.failing_here = failing

    def attempt(self, model, problem, method):
        self.failing = {*self.failing_here} if method == "impute" else {}
        return super().attempt(model, problem, method)


def test_where_the_best_fails_the_next_fills_and_where_it_was_named_nothing_does(only):
    only("linear", "exact-angles", "exact-places")
    mask = make_mask(*GAPS)
    filled = fill_here(ask(make_waves(), mask), FailsOnTheFile("exact-angles"))
    in_deg = np.array(make_waves().units)[np.nonzero(mask)[1]] == "deg"
    assert "exact-angles" not in filled.models
    assert {*filled.models[~in_deg]} == {"exact-places"}
    assert filled.failed == {"exact-angles": "cannot do it"}
    with pytest.raises(UsageError, match="linear did not fill it: cannot do it; choose another"):
        fill_here(ask(make_waves(), mask, models="linear"), Here(failing=("linear",)))


def test_which_models_exceeded_limits_is_noted_wherever_they_did(only):
    only("linear", "exact-angles", "exact-places")
    request = ask(make_waves(), make_mask(*GAPS))
    assert fill_here(request).stopped == ()
    assert fill_here(request, Here(failing=("linear",))).stopped == ()
    assert fill_here(request, Here(stopped=("linear",))).stopped == ("linear",)

    class Late(FailsOnTheFile):
        def attempt(self, model, problem, method):
            attempt = super().attempt(model, problem, method)
            return replace(attempt, stopped=attempt.prediction is None)

    assert fill_here(request, Late("exact-places")).stopped == ("exact-places",)


def test_without_room_for_a_hold_out_a_model_is_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match="name a model with --model"):
        fill_here(ask(waves(), mask))


def test_a_model_is_not_asked_about_frames_in_which_nobody_is_there(waves, hidden):
    everything = [0, 1, 2, 3]
    mask = hidden(
        (0, 30, everything), (50, 60, [0, 1]), (70, 80, everything), (190, 200, everything)
    )
    problem = select(waves().hide(mask), NamedEntries()).problem
    np.testing.assert_array_equal(problem.given.times, waves().times[30:190])
    np.testing.assert_array_equal(problem.target, mask[30:190])


def test_entries_are_filled_at_their_frames_though_frames_before_them_are_cut(waves, hidden):
    mask = hidden((0, 30, [0, 1, 2, 3]), (50, 60, [0, 1]))
    filled = fill_here(select(waves().hide(mask), NamedEntries(model="linear")))
    (line,) = LinearImputer().fit([waves()]).impute([waves().hide(mask)])
    np.testing.assert_allclose(filled.recording.values[50:60, :2], line.mean[50:60, :2])
    assert not filled.recording.visible[:30].any()
