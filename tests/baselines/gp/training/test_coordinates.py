import numpy as np
import pytest
from hypothesis import given

from mocapbench.baselines.gp.training.coordinates import Coordinates


def _around(case):
    draws = {name: 1 + 4 * (name == "child") for name in case.structure.layers}
    return Coordinates.around(case.parameters, draws, case.replicates.times)


def test_of_and_at_are_inverse(cases):
    @given(cases)
    def law(case):
        coordinates = _around(case)
        moved = case.parameters.at(case.parameters.flat - 0.7)
        np.testing.assert_allclose(
            coordinates.at(coordinates.of(moved)).flat, moved.flat, rtol=1e-12, atol=1e-12
        )

    law()


def test_the_pulled_back_gradient_is_that_of_finite_differences(case):
    example = case(np.random.default_rng(0), n_components=2)
    coordinates, slope = _around(example), np.random.default_rng(1).standard_normal
    weights = slope(example.parameters.flat.shape)

    def function(point):
        return np.sin(coordinates.at(point).flat) @ weights

    point = coordinates.of(example.parameters) + 0.1
    gradient = np.cos(coordinates.at(point).flat) * weights
    steps = 1e-6 * np.eye(len(point))
    expected = [(function(point + step) - function(point - step)) / 2e-6 for step in steps]
    np.testing.assert_allclose(
        coordinates.pull_back(point, gradient), expected, rtol=1e-6, atol=1e-8
    )


def test_layers_of_few_draws_have_smaller_coordinates_and_noise_is_relative_to_the_origin(case):
    example = case(np.random.default_rng(0))
    point = _around(example).of(example.parameters)
    n_outputs, n_layer = 2, len(example.parameters.flat) // 2 - 1
    np.testing.assert_array_equal(point[-n_outputs:], 1.0)
    assert point[0] / example.parameters.flat[0] == pytest.approx(5**-0.5)
    assert point[n_layer] == pytest.approx(example.parameters.flat[n_layer])
