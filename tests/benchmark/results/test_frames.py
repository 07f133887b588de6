import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.benchmark import Address, Record, Status, job_table, score_table

ADDRESS = Address("t", 1, "c", 0, "l")


def _record(parts):
    return Record(
        **{"key": "k", "fit_key": "f", "seed": 3, "model": "m", "parameters": {"n": 2}},
        address=ADDRESS,
        status=Status.OK,
        scores={"mcc": 2.0},
        parts={"mcc": parts},
    )


def _spread(parts):
    (value,) = score_table([Record.from_json(_record(parts).to_json())])["sample_two_sd"]
    return value


def test_the_spread_is_two_standard_deviations_over_samples():
    assert _spread({"sample": [1.0, 3.0]}) == pytest.approx(2.0 * np.sqrt(2.0))


@pytest.mark.parametrize("parts", [{}, {"output": [1.0, 2.0]}, {"sample": [1.0]}])
def test_what_is_no_mean_over_samples_has_no_spread_over_them(parts):
    assert np.isnan(_spread(parts))


def test_a_sample_that_is_not_defined_leaves_none():
    assert np.isnan(_spread({"sample": [1.0, float("nan")]}))


@pytest.mark.parametrize("table", [score_table, job_table])
def test_a_row_has_the_whole_address_of_its_record(table):
    (row,) = table([_record({})]).to_dict("records")
    named = {name: row[name] for name in ("task", "case", "fold", "label")}
    assert named == {name: getattr(ADDRESS, name) for name in named}
    assert (row["model"], row["parameters"]) == ("m", "n=2")


def test_a_job_without_its_recordings_names_them_and_the_command_that_gets_them():
    lacking = replace(_record({}), missing=("12_02", "own:a walk"), fetch="mocapbench data fetch")
    (row,) = job_table([lacking]).to_dict("records")
    assert (row["missing"], row["fetch"]) == ("12_02 'own:a walk'", "mocapbench data fetch")


def test_what_tells_two_rows_of_one_address_apart_is_in_the_table():
    (row,) = score_table([_record({})]).to_dict("records")
    assert (row["version"], row["seed"], row["key"], row["value"]) == (1, 3, "k", 2.0)


def test_a_table_of_many_scores_takes_less_than_600_bytes_a_score_while_it_is_made():
    n_records, n_scores = 300, 20
    scores = {f"metric {number}": float(number) for number in range(n_scores)}
    records = [replace(_record({}), key=f"{k}", scores=scores) for k in range(n_records)]
    score_table(records)
    tracemalloc.start()
    score_table(records)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 600 * n_records * n_scores
