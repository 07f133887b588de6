"""The two parts of the mean error norm per frame."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import angle_error_per_frame, rms_per_frame, root_error_per_frame


def test_each_part_is_the_norm_over_its_own_outputs(make):
    outcome = make([[3.0, 1.0, 4.0]], 0.0, units=("deg", "", "deg"))
    assert angle_error_per_frame(outcome).value == 5.0
    assert root_error_per_frame(outcome).value == 1.0


@given(seed=st.integers(0, 2**32 - 1))
def test_the_squares_of_the_parts_add_up_at_every_frame(draw, seed):
    whole, angles, root = (
        np.nan_to_num(metric(draw(seed)).parts["frame"]) ** 2
        for metric in (rms_per_frame, angle_error_per_frame, root_error_per_frame)
    )
    np.testing.assert_allclose(angles + root, whole)


def test_a_part_that_is_nowhere_hidden_is_not_a_number(make):
    outcome = make([[3.0, 1.0]], 0.0, hidden=np.array([[True, False]]), units=("deg", ""))
    assert np.isnan(root_error_per_frame(outcome).value)


@pytest.mark.parametrize(
    ("units", "angles", "root"),
    [(("deg", ""), True, True), (("deg", "deg"), True, False), (("cm", "cm"), False, False)],
)
def test_parts_are_defined_where_outputs_are_angles(make, units, angles, root):
    outcome = replace(make([[3.0, 1.0]], 0.0), units=units)
    assert angle_error_per_frame.applies(outcome) is angles
    assert root_error_per_frame.applies(outcome) is root
