"""The conformance kit names the fault of a metric that does not conform."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.benchmark.testing import ConformanceError, check_metric
from mocapbench.metrics import Direction, Imputation, Score, metric


def _value(outcome):
    """Return one."""
    return Score(1.0)


def test_what_is_no_metric_is_refused():
    with pytest.raises(ConformanceError, match=r"expected a mocapbench\.metrics\.Metric"):
        check_metric(_value)


def _undocumented(outcome):
    return Score(1.0)


def _nan(outcome):
    """Return NaN."""
    return Score(np.nan)


def _number(outcome):
    """Return no Score."""
    return 1.0


def _complex(outcome):
    """Return a complex number."""
    return Score(1 + 2j)


def _array(outcome):
    """Return a number an entry."""
    return Score(outcome.truth)


def _listed(outcome):
    """Return parts that are no array."""
    return Score(1.0, {"frame": [1.0]})


def _random(outcome):
    """Return something else every time."""
    return Score(float(np.random.default_rng().random()))


def _everything(outcome):
    """Return the error over all entries."""
    return Score(float(((outcome.truth - outcome.mean) ** 2).mean()))


def _raises(outcome):
    """Raise."""
    raise ZeroDivisionError("no frames")


def _in_place(outcome):
    """Return the mean error at hidden entries."""
    errors = outcome.mean
    errors -= outcome.truth
    return Score(float(errors[outcome.hidden].mean()))


@metric(title="M", direction=Direction.LOWER)
def m(outcome: Imputation):
    """Return one."""
    return Score(1.0)


def test_a_metric_that_conforms_passes():
    check_metric(m)


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"statistic": _undocumented}, "a docstring of the statistic"),
        ({"statistic": _nan}, "a finite value of a plain outcome, got nan"),
        ({"statistic": _number}, "to return a Score, got float"),
        ({"statistic": _complex}, r"a Score of one real number, got \(1\+2j\); write"),
        ({"statistic": _array}, r"one real number, got an array of float64 of shape \(20, 2\)"),
        ({"statistic": _listed}, r"parts of its Score as arrays, got \[1.0\] for 'frame'; write"),
        ({"statistic": _random}, "draw nothing in a metric"),
        ({"statistic": _everything}, "whatever the visible entries are"),
        ({"statistic": _raises}, "got ZeroDivisionError: no frames"),
        ({"statistic": _in_place}, "got ValueError: .*read-only"),
        ({"outcome": int}, "expected an outcome among"),
    ],
)
def test_the_fault_of_a_metric_is_named(changes, complaint):
    with pytest.raises(ConformanceError, match=rf"^metric m: .*{complaint}"):
        check_metric(replace(m, **changes))
