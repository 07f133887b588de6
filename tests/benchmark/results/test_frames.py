import numpy as np
import pytest

from mocapbench.benchmark.results.frames import score_table
from mocapbench.benchmark.runs.record import Record, Status


def _spread(parts):
    address = {"task": "t", "version": 1, "case": "c", "fold": 0, "seed": 0, "label": "l"}
    record = Record(
        **{"key": "k", "fit_key": "f", "model": "m", "parameters": {}, **address},
        status=Status.OK,
        scores={"mcc": 2.0},
        parts={"mcc": parts},
    )
    (value,) = score_table([Record.from_json(record.to_json())])["sample_two_sd"]
    return value


def test_the_spread_is_two_standard_deviations_over_samples():
    assert _spread({"sample": [1.0, 3.0]}) == pytest.approx(2.0 * np.sqrt(2.0))


@pytest.mark.parametrize("parts", [{}, {"output": [1.0, 2.0]}, {"sample": [1.0]}])
def test_what_is_no_mean_over_samples_has_no_spread_over_them(parts):
    assert np.isnan(_spread(parts))


def test_a_sample_that_is_not_defined_leaves_none():
    assert np.isnan(_spread({"sample": [1.0, float("nan")]}))
