import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.hold_outs import make_hold_outs
from mocapbench.benchmark.filling.gap_problem import GapProblem


@pytest.fixture
def held_out(waves):
    """Return a function from a mask to the hold-outs of waves, or others, with such gaps."""

    def make(mask, whole=None):
        problem = GapProblem((whole or waves()).hide(mask), mask)
        return make_hold_outs(problem, np.random.default_rng(0))

    return make
