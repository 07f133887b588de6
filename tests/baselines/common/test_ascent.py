import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.common.ascent import ascend


@given(st.lists(st.floats(0.0, 9.0), min_size=1, max_size=8), st.floats(0.0, 5.0))
def test_it_stops_after_the_first_rise_below_the_threshold(rises, threshold):
    values = np.cumsum([0.0, *rises])
    run = ascend(0, lambda n: n + 1, lambda n: values[n], max_iter=len(rises), threshold=threshold)
    small = np.flatnonzero(np.diff(values) < threshold)
    assert run.converged == bool(len(small))
    assert run.state == run.n_iterations == (small[0] + 1 if len(small) else len(rises))
    assert run.objectives == pytest.approx(tuple(values[: run.n_iterations + 1]))
