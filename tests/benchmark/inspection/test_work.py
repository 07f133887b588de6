"""Seconds that fits took."""

import csv
from dataclasses import replace

import pytest

from mocapbench.benchmark.inspection.work import MEASURED, alike, of_records, typical
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import PROFILES

ONE = Address("toy-synthesis", 1, "test 1", 0, "hgp")


def record(address, fit, predict):
    times = {"fit_seconds": fit, "predict_seconds": predict}
    return Record("k", "f", address, 0, "hgp", {}, Status.OK, **times)


def test_records_tell_the_mean_of_their_entrant_in_their_task_or_elsewhere():
    known = of_records([record(ONE, 1.0, 1.0), record(ONE._replace(fold=1), 4.0, None)])
    assert known.expect_seconds(alike(ONE._replace(case="test 2"))) == 3.0
    more = of_records([record(ONE, 1.0, 1.0), record(ONE._replace(case="test 2"), 8.0, 0.0)])
    assert more.expect_seconds(alike(ONE._replace(case="test 2"))) == 8.0
    assert known.expect_seconds(alike(ONE._replace(task="another"))) == 3.0
    assert not known.knows(alike(ONE._replace(label="moa-3"))[:2])


def test_records_without_a_fit_tell_nothing():
    missing = replace(record(ONE, None, None), status=Status.DATA_MISSING)
    assert not of_records([missing]).knows(alike(ONE))


@pytest.mark.parametrize("profile", PROFILES)
def test_of_every_profile_something_is_typical(profile):
    known = typical(profile)
    assert known.expect_seconds(alike(ONE)) > 0
    assert known.knows([()])
    assert MEASURED[profile] in PROFILES


def test_the_table_has_one_positive_value_of_each_entrant():
    path = of_records.__globals__["_TYPICAL"]
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert len({(row["profile"], row["task"], row["label"]) for row in rows}) == len(rows)
    assert all(float(row["seconds"]) > 0 for row in rows)
    assert {row["profile"] for row in rows} == set(MEASURED.values())
