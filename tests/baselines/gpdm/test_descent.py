"""Minimisation over several arrays at once."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.descent import descend

CENTRES = (np.array([[1.0, -2.0]]), np.array([3.0, 0.5, -1.0]))
WIDTHS = (1.0, 10.0)


def quadratic(*arrays):
    residuals = [array - centre for array, centre in zip(arrays, CENTRES, strict=True)]
    terms = zip(WIDTHS, residuals, strict=True)
    value = sum(0.5 * width * float((residual**2).sum()) for width, residual in terms)
    return value, [width * residual for width, residual in zip(WIDTHS, residuals, strict=True)]


def rosenbrock(x):
    value = (1 - x[0]) ** 2 + 100 * (x[1] - x[0] ** 2) ** 2
    gradient = [-2 * (1 - x[0]) - 400 * x[0] * (x[1] - x[0] ** 2), 200 * (x[1] - x[0] ** 2)]
    return float(value), (np.array(gradient),)


def test_the_minimum_of_a_quadratic_is_reached_in_every_array():
    ends = descend(quadratic, [np.zeros_like(centre) for centre in CENTRES], 50)
    for end, centre in zip(ends, CENTRES, strict=True):
        assert end.shape == centre.shape
        np.testing.assert_allclose(end, centre, atol=1e-6)


@pytest.mark.parametrize("start", [(-1.2, 1.0), (2.0, 2.0), (0.0, -3.0)])
def test_more_steps_never_raise_the_objective(start):
    start = np.array(start)
    ends = [descend(rosenbrock, [start], n_steps)[0] for n_steps in (1, 2, 5, 10, 40)]
    values = [rosenbrock(x)[0] for x in (start, *ends)]
    assert (np.diff(values) <= 1e-12).all()
    assert values[-1] < 1e-4


def test_the_start_is_left_as_it_was():
    start = np.array([2.0, 2.0])
    descend(rosenbrock, [start], 3)
    np.testing.assert_array_equal(start, [2.0, 2.0])
