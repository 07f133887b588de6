import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis.extra.numpy import array_shapes, arrays

from mocapbench.baselines import Synthesiser
from mocapbench.benchmark import InvalidPredictionError, SynthesiseProblem

TIMES = np.arange(5.0)


class Noise(Synthesiser):
    """Draws white noise around one number."""

    def __init__(self, mean=0.0):
        self.mean = mean

    def fit(self, recordings):
        return self

    def sample(self, times, n_samples, random_state):
        rng = np.random.default_rng(random_state)
        return self.mean + rng.standard_normal((n_samples, len(times), 2))


PROBLEM = SynthesiseProblem((), TIMES, 4, (np.zeros((5, 2)), np.ones((5, 2))))


def test_samples_are_seeded_and_checked():
    one, two = (PROBLEM.solve(Noise(), 7) for _ in range(2))
    np.testing.assert_array_equal(one, two)
    assert not np.array_equal(one, PROBLEM.solve(Noise(), 8))
    outcome = PROBLEM.outcome(one)
    assert outcome.samples.shape == (4, 5, 2)
    assert outcome.references.shape == (2, 5, 2)
    with pytest.raises(InvalidPredictionError, match="expected finite samples of shape"):
        PROBLEM.solve(Noise(np.nan), 0)


@settings(max_examples=25)
@given(arrays(np.float64, array_shapes(min_dims=3, max_dims=3, max_side=4)))
def test_an_answer_survives_the_store(survives, values):
    other = {"trend-mean": TIMES}
    assert survives(values, PROBLEM.to_arrays, PROBLEM.from_arrays, other)
