"""Metrics and recordings take the same values for numbers, and say the same of others."""

import numpy as np
import pytest

from mocapbench.datasets import Recording
from mocapbench.metrics import Synthesis


def recorded(values):
    return Recording("r", np.arange(len(values)), values, ["a"], [""]).values


def sampled(values):
    return Synthesis([values], [values]).samples[0]


@pytest.mark.parametrize("read", [recorded, sampled])
@pytest.mark.parametrize(
    "values",
    [
        [["1"], ["2"]],
        np.array([[1.0], ["2"]], dtype=object),
        [[1j], [2.0]],
        [[1.0], [2.0, 3.0]],
        [[np.datetime64("2020-01-01")], [np.datetime64("2020-01-02")]],
    ],
    ids=["text", "text among numbers", "complex", "ragged", "dates"],
)
def test_what_is_not_a_real_number_is_refused(read, values):
    with pytest.raises(ValueError, match="to be real numbers, in rows of the same length, got"):
        read(values)


@pytest.mark.parametrize("read", [recorded, sampled])
@pytest.mark.parametrize(
    "values", [[[1], [2]], [[True], [2.0]], np.array([[1.0], [2]], dtype=object)]
)
def test_real_numbers_of_any_kind_are_taken(read, values):
    np.testing.assert_array_equal(read(values), [[1.0], [2.0]])
