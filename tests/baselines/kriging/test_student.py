import numpy as np
import pytest
from scipy.stats import t

from mocapbench.baselines.kriging.conditioned import student_variance


def test_it_is_the_variance_of_students_t():
    for n_values in range(3, 30):
        assert student_variance(n_values) == pytest.approx(t(n_values).var())


def test_more_values_never_leave_more_doubt():
    factors = [student_variance(n_values) for n_values in range(1, 30)]
    assert (np.diff(factors) <= 0.0).all()
    assert np.isfinite(factors).all()
