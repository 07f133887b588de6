"""What a model costs is predicted from sizes of a problem alone, and grows with each of them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.costs import (
    CALIBRATING,
    STAND_IN,
    START,
    Sizes,
    count_seconds,
    load_measured_costs,
    measure_sizes,
    predict_calibrated_seconds,
    predict_seconds,
)
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import CALIBRATIONS, MODELS, build_unfitted, find_calibration
from mocapbench.datasets import Recording

PREDICTIONS = (predict_seconds, predict_calibrated_seconds)
MEASURED = sorted({name for name, _ in load_measured_costs()})
LARGEST = Sizes(200, 36_000, 300, 500, 3000, 300, 5000)


def make_problem(*, n_frames=300, n_channels=6, n_gaps=2, length=10, width=3, n_train=0):
    values = np.random.default_rng(0).normal(size=(n_frames, n_channels))
    names = tuple(f"M{k // 3}.{'xyz'[k % 3]}" for k in range(n_channels))
    target = np.zeros(values.shape, dtype=bool)
    for gap in range(n_gaps):
        start = 10 + gap * (n_frames - 20) // n_gaps
        target[start : start + length, :width] = True
    recordings = [
        Recording(f"r{k}", np.arange(n_frames) / 100, values, names, ("mm",) * n_channels)
        for k in range(n_train + 1)
    ]
    return GapProblem(recordings[0].hide(target), target, tuple(recordings[1:]))


class Mine(Imputer):
    """A model of a user's own."""

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(one, np.zeros(one.values.shape)) for one in recordings]


@pytest.fixture
def register(monkeypatch):
    """Return a function that registers a model that declares some costs as ``mine``."""

    def add(fill_cost):
        kind = type("Declaring", (Mine,), {"fill_cost": fill_cost})
        monkeypatch.setitem(MODELS._added, "mine", kind)

    return add


def test_every_model_that_fills_gaps_was_measured():
    known = set(MODELS.names()) - set(MODELS.names_of_others())
    models = {name: build_unfitted(name) for name in known}
    able = {
        name
        for name, model in models.items()
        if "fills frames" in model.provides and model.needs <= {"coordinates"}
    }
    missing = able - set(MEASURED)
    assert not missing, (
        "measure what these cost: python docs/evidence/fill_costs.py measure MEASURED.csv "
        f"{' '.join(sorted(missing))}, and add the rows of the table that "
        "python docs/evidence/fill_costs.py fit MEASURED.csv writes"
    )
    expected = {(name, "impute_uncalibrated") for name in able}
    expected |= {(name, "impute") for name in able if find_calibration(name)}
    assert {*load_measured_costs()} == expected


@given(
    st.sampled_from(sorted(load_measured_costs())),
    st.tuples(*(st.integers(1, most) for most in LARGEST)),
    st.tuples(*(st.integers(0, most) for most in LARGEST)),
)
def test_costs_grow_with_every_size_of_a_problem(key, sizes, more):
    cost = load_measured_costs()[key]
    seconds = count_seconds(cost, Sizes(*sizes))
    assert seconds >= START
    for number, grown in enumerate(np.add(sizes, np.diag(more)).tolist()):
        assert count_seconds(cost, Sizes(*grown)) >= seconds, Sizes._fields[number]


@given(st.sampled_from(sorted(load_measured_costs())), st.integers(1, 50), st.integers(1, 50))
def test_to_cut_a_problem_into_more_windows_does_not_make_it_cheaper(key, n_windows, n_gaps):
    cost = load_measured_costs()[key]
    one, more = (
        count_seconds(cost, Sizes(n, 200, 30, n_windows * n_gaps / n, 20, 3, 3))
        for n in (1, n_windows)
    )
    assert more >= one * (1 - 1e-12)


GROWING = {
    "n_frames": (300, 900, 5000),
    "n_channels": (6, 60, 120),
    "n_gaps": (2, 5, 8),
    "length": (5, 10, 30),
    "width": (1, 3, 5),  # gaps of whole frames are of another kind, which some models fill sooner
    "n_train": (0, 1, 3),
}


@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.parametrize("predict", PREDICTIONS)
@pytest.mark.parametrize("size", GROWING)
def test_larger_problems_cost_more(name, predict, size):
    seconds = [predict(name, make_problem(**{size: value})) for value in GROWING[size]]
    assert seconds == sorted(seconds)
    assert seconds[0] >= START


@pytest.mark.parametrize("name", MEASURED)
@pytest.mark.parametrize("predict", PREDICTIONS)
def test_costs_depend_neither_on_names_nor_on_the_order_of_channels(name, predict):
    problem = make_problem(n_frames=900, n_train=1)
    order = np.random.default_rng(1).permutation(6)

    def rename(recording):
        names, units = ([each[k] for k in order] for each in (recording.channels, recording.units))
        values = recording.values[:, order]
        return Recording(f"other {recording.name}", recording.times, values, names, units)

    train = tuple(map(rename, problem.train))
    other = GapProblem(rename(problem.given), problem.target[:, order], train)
    assert predict(name, other) == predict(name, problem)


def test_values_do_not_count():
    problem = make_problem()
    scaled = replace(problem.given, values=1000 * problem.given.values)
    other = GapProblem(scaled, problem.target)
    assert measure_sizes(other, None) == measure_sizes(problem, None)


def test_sizes_are_those_of_the_windows_that_a_model_fills():
    problem = make_problem(n_frames=3000, n_gaps=3, length=20, width=2, n_train=1)
    assert measure_sizes(problem, None) == (1, 6000, 6, 3, 20, 1, 6)
    assert measure_sizes(problem, 500) == (3, 500, 6, 1, 20, 1, 2)


def test_gaps_of_whole_frames_have_no_parts():
    assert measure_sizes(make_problem(width=6), None)[3:] == (2, 10, 1, 1)


def test_channels_that_have_all_gaps_together_are_a_group():
    problem = make_problem(n_gaps=2, width=4)
    mask = np.zeros(problem.target.shape, dtype=bool)
    mask[100:105, 2:5] = True
    more = GapProblem(problem.given.hide(mask), problem.target)
    assert measure_sizes(more, None)[3:] == (3, 10, 3, 2 * 4 + 3)


def test_gaps_beside_those_wanted_count_where_a_window_has_them():
    problem = make_problem(n_frames=3000, n_gaps=3, length=20)
    wanted = problem.target.copy()
    wanted[1500:] = False
    asked = GapProblem(problem.given, wanted)
    assert measure_sizes(asked, None).gaps == 3
    assert measure_sizes(asked, 500).gaps == 1


def test_a_channel_that_nobody_has_seen_or_wants_costs_nothing():
    problem = make_problem()
    mask = np.zeros(problem.target.shape, dtype=bool)
    mask[:, 5] = True
    unseen = replace(problem, given=problem.given.hide(mask))
    assert measure_sizes(unseen, None) == measure_sizes(make_problem(n_channels=5), None)


def test_a_gap_longer_than_a_window_costs_more_than_any_time():
    assert predict_seconds("gpdm", make_problem(n_frames=1000, length=400)) == math.inf
    assert predict_seconds("linear", make_problem(n_frames=1000, length=400)) < math.inf


def test_calibration_does_not_make_a_fill_cheaper():
    calibrated = [name for name in MEASURED if name in CALIBRATIONS.names()]
    problem = make_problem(n_frames=600, n_channels=60, n_gaps=6)
    ratios = [
        predict_calibrated_seconds(n, problem) / predict_seconds(n, problem) for n in calibrated
    ]
    assert min(ratios) >= 1.0


def test_a_model_of_another_package_costs_what_it_declares(register):
    register({"seconds": 1e-6, "frames": 2, "channels": 1})
    for predict in PREDICTIONS:  # it has no calibration
        assert predict("mine", make_problem()) == pytest.approx(START + 1e-6 * 300**2 * 6)


def test_a_model_that_declares_costs_and_is_calibrated_costs_more(register, monkeypatch):
    register({"seconds": 0.1})
    monkeypatch.setitem(CALIBRATIONS._added, "mine", lambda model: model)
    assert predict_seconds("mine", make_problem()) == pytest.approx(START + 0.1)
    calibrated = predict_calibrated_seconds("mine", make_problem())
    assert calibrated == pytest.approx(START + 0.1 * CALIBRATING)


@pytest.mark.parametrize("predict", PREDICTIONS)
def test_a_model_that_declares_nothing_costs_as_much_as_another(register, predict):
    register(None)
    assert predict("mine", make_problem()) == predict_seconds(STAND_IN, make_problem())


@pytest.mark.parametrize(
    "declared",
    [
        3.0,
        {},
        {"frames": 1},
        {"seconds": "fast"},
        {"seconds": 1, "pages": 2},
        {"seconds": 1, "frames": -1},
        {"seconds": 1, "frames": 1000},
        {"seconds": math.nan},
        {"seconds": math.inf},
    ],
)
def test_costs_of_another_form_are_refused(register, declared):
    register(declared)
    with pytest.raises(UsageError, match="model 'mine': expected a fill_cost that maps 'seconds'"):
        predict_seconds("mine", make_problem())


def test_a_model_without_its_calibration_costs_the_same_before_calibration():
    problem = make_problem()
    assert predict_seconds("lds-uncalibrated", problem) == predict_seconds("lds", problem)


def test_a_gap_that_is_left_open_counts_as_far_as_a_window_has_it():
    problem = make_problem(n_frames=3000, n_gaps=3, length=20)
    mask = np.zeros(problem.target.shape, dtype=bool)
    mask[500:2500, 5] = True
    beside = GapProblem(problem.given.hide(mask), problem.target)
    assert measure_sizes(beside, None).longest == 2000
    assert measure_sizes(beside, 500).longest == 500
