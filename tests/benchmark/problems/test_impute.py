import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark import (
    ImputeProblem,
    InvalidPredictionError,
    Unit,
    hide_frames,
)
from mocapbench.datasets import Recording

CHANNELS = ("a.rx", "b.ry")
TRUTH = np.array([[0.0, 10.0], [1.0, 20.0], [4.0, 30.0]])
HIDDEN = np.array([[False, True], [True, False], [False, False]])


class Constant(Imputer):
    """Fills every hidden entry with one number."""

    def __init__(self, mean=0.0, variance=None):
        self.mean = mean
        self.variance = variance

    def fit(self, recordings):
        self.names_ = [recording.name for recording in recordings]
        return self

    def impute(self, recordings):
        shape = recordings[0].values.shape
        variance = None if self.variance is None else np.full(shape, self.variance)
        return [Prediction.around(r, np.full(shape, self.mean), variance) for r in recordings]


class Answers(Constant):
    """Returns the predictions that it was built with."""

    def __init__(self, predictions=()):
        self.predictions = predictions

    def impute(self, recordings):
        return self.predictions


def _recording(name, values):
    return Recording(name, np.arange(3.0), values, CHANNELS, ("deg", "deg"))


@pytest.fixture(scope="module")
def problem():
    given, other = _recording("test", TRUTH).hide(HIDDEN), _recording("other", TRUTH + 1.0)
    return ImputeProblem((given, other), (given,), (TRUTH,), Unit.range_of(TRUTH))


def test_the_outcome_is_in_the_unit_of_the_complete_range(problem):
    outcome = problem.outcome(problem.solve(Constant(4.0, 16.0), 0))
    np.testing.assert_array_equal(outcome.hidden, HIDDEN)
    np.testing.assert_allclose(outcome.truth, (TRUTH - [0, 10]) / [4, 20])
    np.testing.assert_allclose(outcome.mean[HIDDEN], [(4 - 10) / 20, 4 / 4])
    np.testing.assert_allclose(outcome.variance[HIDDEN], [16 / 400, 16 / 16])


def test_visible_moments_count_every_given_recording_once(problem):
    outcome = problem.outcome(problem.solve(Constant(), 0))
    visible = np.array([0.0, 4.0, 1.0, 2.0, 5.0]) / 4.0
    np.testing.assert_allclose(outcome.visible_mean[0], visible.mean())
    np.testing.assert_allclose(outcome.visible_variance[0], visible.var())


def test_what_the_model_sees_holds_nothing_of_the_truth(problem):
    for recording in (*problem.train, *problem.given):
        if recording.name == "test":
            assert np.isnan(recording.values[HIDDEN]).all()


@pytest.mark.parametrize("variance", [0.0, -1e-20, np.nan, np.inf])
def test_a_variance_that_is_none_is_refused(problem, variance):
    with pytest.raises(InvalidPredictionError, match="variance"):
        problem.solve(Constant(0.0, variance), 0)


FILLED = Prediction(TRUTH)
UNSURE = Prediction(TRUTH, np.ones_like(TRUTH))


@pytest.mark.parametrize("solution", [[], [FILLED, FILLED], [TRUTH], (FILLED,), None])
def test_an_answer_is_a_list_of_one_prediction_per_recording(problem, solution):
    with pytest.raises(InvalidPredictionError, match="impute: expected a list of 1 Prediction"):
        problem.solve(Answers(solution), 0)


def test_all_predictions_have_a_variance_or_none_has(problem):
    both = ImputeProblem(problem.train, problem.given * 2, problem.truth * 2, problem.unit)
    assert both.outcome(both.solve(Answers([FILLED, FILLED]), 0)).variance is None
    assert both.outcome(both.solve(Answers([UNSURE, UNSURE]), 0)).variance.shape == (6, 2)
    with pytest.raises(InvalidPredictionError, match="a variance with every Prediction or with no"):
        both.solve(Answers([FILLED, UNSURE]), 0)


def test_several_recordings_are_put_one_below_the_other(problem):
    both = ImputeProblem(problem.train, problem.given * 2, problem.truth * 2, problem.unit)
    outcome = both.outcome(
        both.solve(Answers([UNSURE, Prediction(2.0 * TRUTH, 3.0 * TRUTH + 1)]), 0)
    )
    assert outcome.truth.shape == outcome.hidden.shape == (6, 2)
    np.testing.assert_allclose(outcome.mean, problem.unit.of(np.vstack([TRUTH, 2.0 * TRUTH])))
    expected = np.vstack([np.ones_like(TRUTH), 3.0 * TRUTH + 1]) / [4**2, 20**2]
    np.testing.assert_allclose(outcome.variance, expected)


@pytest.mark.parametrize("seen", [True, False])
def test_a_problem_of_one_recording_says_whether_models_learn_from_it(seen):
    one, other = _recording("one", TRUTH), _recording("other", TRUTH + 1.0)
    problem = ImputeProblem.of_one(one, hide_frames(1, 2, 3, 2), (other,), seen_in_fit=seen)
    assert [recording.name for recording in problem.train] == ["other", "one"][: 1 + seen]
    assert (~problem.given[0].visible[:, 0]).tolist() == [False, True, False]
    np.testing.assert_array_equal(problem.truth[0], TRUTH)
    np.testing.assert_array_equal(problem.unit.of(TRUTH), TRUTH)


@settings(max_examples=25)
@given(st.data(), st.integers(1, 12), st.booleans())
def test_an_answer_survives_the_store(survives, problem, data, n_recordings, has_variance):
    values = arrays(np.float64, (3, 2), elements=st.floats(width=64))
    predictions = tuple(
        Prediction(data.draw(values), np.abs(data.draw(values)) if has_variance else None)
        for _ in range(n_recordings)
    )
    other = {"trend-mean": TRUTH}
    assert survives(predictions, problem.to_arrays, problem.from_arrays, other)
