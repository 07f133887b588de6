import numpy as np
from hypothesis import given
from hypothesis import strategies as st


def test_flat_and_at_are_inverse(cases):
    @given(cases)
    def law(case):
        parameters = case.parameters
        flat = np.random.default_rng(0).standard_normal(parameters.flat.shape)
        np.testing.assert_array_equal(parameters.at(flat).flat, flat)
        for one, two in zip(parameters.at(parameters.flat).leaves, parameters.leaves, strict=True):
            np.testing.assert_array_equal(one, two)

    law()


def test_natural_parameters_are_positive(cases):
    @given(cases, st.floats(-5.0, 5.0))
    def law(case, shift):
        parameters = case.parameters.at(case.parameters.flat + shift)
        assert (parameters.noise > 0).all()
        for layer in parameters.layers.values():
            assert (layer.lengthscales > 0).all()
            assert (layer.kappa >= 0).all()

    law()


def test_zeros_have_the_shapes_of_the_layer(case):
    layer = case(np.random.default_rng(0), n_components=2, rank=2).parameters.layers["child"]
    for zeros, leaf in zip(layer.zeros().leaves, layer.leaves, strict=True):
        np.testing.assert_array_equal(zeros, 0.0 * leaf)


def test_at_keeps_the_shapes(case):
    parameters = case(np.random.default_rng(1), n_components=2, rank=2, n_outputs=3).parameters
    assert parameters.shapes == {"parent": (2, 3, 2), "child": (2, 3, 2)}
    assert parameters.at(0.0 * parameters.flat).shapes == parameters.shapes
