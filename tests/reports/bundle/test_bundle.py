from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics.base import Direction
from mocapbench.reports.bundle.metric_info import MetricInfo

finite = st.floats(-1e6, 1e6)


@pytest.mark.parametrize("table", ["scores", "records"])
@pytest.mark.parametrize("column", ["task", "label", "fold"])
def test_a_missing_column_is_named(bundle, table, column):
    frame = getattr(bundle, table).drop(columns=column)
    with pytest.raises(ValueError, match=f"{table}: expected columns .*'{column}'"):
        replace(bundle, **{table: frame})


@pytest.mark.parametrize(
    ("table", "column"),
    [("scores", "label"), ("scores", "case"), ("scores", "metric"), ("records", "status")],
)
def test_a_name_that_no_layout_knows_is_refused(bundle, table, column):
    frame = getattr(bundle, table).head(3).assign(**{column: "stranger"})
    with pytest.raises(ValueError, match="stranger"):
        replace(bundle, **{table: frame})


@pytest.mark.parametrize("direction", Direction)
def test_a_direction_may_be_given_by_value(direction):
    assert MetricInfo("m", "M", direction.value, 0.5).direction is direction


def test_an_unknown_direction_is_refused():
    with pytest.raises(ValueError, match="sideways"):
        MetricInfo("m", "M", "sideways")


def test_a_target_metric_needs_its_target():
    with pytest.raises(ValueError, match="expected a target"):
        MetricInfo("m", "M", Direction.TARGET)


@given(finite, finite)
def test_higher_is_lower_of_the_negative(a, b):
    lower, higher = (MetricInfo("m", "M", d) for d in (Direction.LOWER, Direction.HIGHER))
    assert (lower.loss(a) < lower.loss(b)) == (a < b)
    assert higher.loss(a) == lower.loss(-a)


@given(finite, finite)
def test_nothing_is_better_than_the_target(target, value):
    info = MetricInfo("m", "M", Direction.TARGET, target)
    assert info.loss(target) == 0.0 <= info.loss(value)
