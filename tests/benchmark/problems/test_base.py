import numpy as np
import pytest

from mocapbench.baselines import Imputer, Prediction, Synthesiser
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.datasets import Recording

CHANNELS = ("a.rx", "b.ry")
TRUTH = np.array([[0.0, 10.0], [1.0, 20.0], [4.0, 30.0]])
HIDDEN = np.array([[False, True], [True, False], [False, False]])


class Constant(Imputer, Synthesiser):
    """Answers whatever it was built with."""

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

    def sample(self, times, n_samples, random_state):
        rng = np.random.default_rng(random_state)
        return self.mean + rng.standard_normal((n_samples, len(times), 2))


@pytest.fixture
def problem():
    complete = Recording("test", np.arange(3.0), TRUTH, CHANNELS, ("deg", "deg"))
    other = Recording("other", np.arange(3.0), TRUTH + 1.0, CHANNELS, ("deg", "deg"))
    given = complete.hide(HIDDEN)
    return ImputeProblem((given, other), None, (given,), (TRUTH,), Unit.range_of(TRUTH))


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


@pytest.mark.parametrize("variance", [0.0, -1.0, np.nan, np.inf])
def test_a_variance_that_is_none_is_refused(problem, variance):
    with pytest.raises(InvalidPredictionError, match="variance"):
        problem.solve(Constant(0.0, variance), 0)


def test_samples_are_seeded_and_checked():
    times = np.arange(5.0)
    problem = SynthesiseProblem((), None, times, 4, (np.zeros((5, 2)), np.ones((5, 2))))
    one, two = (problem.solve(Constant(), 7)["samples"] for _ in range(2))
    np.testing.assert_array_equal(one, two)
    assert not np.array_equal(one, problem.solve(Constant(), 8)["samples"])
    outcome = problem.outcome({"samples": one})
    assert outcome.samples.shape == (4, 5, 2)
    assert outcome.references.shape == (2, 5, 2)
    with pytest.raises(InvalidPredictionError, match="expected finite samples of shape"):
        problem.solve(Constant(np.nan), 0)
