import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.text import apart, decimals, number, slug


@pytest.mark.parametrize(
    ("values", "places"),
    [([], 2), ([0.0], 2), ([62.98, 139.75], 2), ([0.5, 0.12], 2), ([0.021], 3), ([1e-9], 4)],
)
def test_places_show_two_digits_of_small_values(values, places):
    assert decimals(values) == places


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False)))
def test_places_are_two_to_four_whatever_the_sign(values):
    assert 2 <= decimals(values) == decimals([-value for value in values]) <= 4


@given(st.floats(-1e9, 1e9), st.integers(2, 4))
def test_a_number_reads_back_to_its_places(value, places):
    text = number(value, places)
    assert "-" not in text
    assert float(text.replace("−", "-")) == pytest.approx(value, abs=0.51 * 10.0**-places)


@given(st.floats(-1e3, 1e3), st.floats(1e-3, 1e3), st.integers(2, 4))
def test_two_values_are_written_apart_with_no_more_digits_than_that_takes(value, more, places):
    found = apart(value, value + more, places)
    assert number(value, found) != number(value + more, found)
    assert found == places or number(value, found - 1) == number(value + more, found - 1)
    assert apart(value, value, places) == places


def test_there_is_no_negative_zero():
    assert number(-1e-9, 3) == "0.000"


@given(st.text(), st.text())
def test_a_slug_needs_no_escaping(one, other):
    assert set(slug(one, other)) <= set("abcdefghijklmnopqrstuvwxyz0123456789-")
