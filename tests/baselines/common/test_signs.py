import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.common.signs import orient_vectors


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 6), st.integers(1, 4))
def test_signs_of_vectors_do_not_count(seed, size, number):
    rng = np.random.default_rng(seed)
    vectors = rng.normal(size=(size, number))
    turned = vectors * rng.choice([-1.0, 1.0], number)
    np.testing.assert_array_equal(orient_vectors(turned), orient_vectors(vectors))
    np.testing.assert_array_equal(np.abs(orient_vectors(vectors)), np.abs(vectors))


def test_rounding_does_not_choose_between_entries_of_one_size():
    for noise in 1e-15 * np.random.default_rng(0).normal(size=(50, 2, 2)):
        vectors = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2.0) + noise
        assert (orient_vectors(vectors)[0] > 0).all()


def test_a_vector_of_zeros_stays():
    np.testing.assert_array_equal(orient_vectors(np.zeros((3, 2))), np.zeros((3, 2)))
