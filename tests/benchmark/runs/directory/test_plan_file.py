import json

import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory.plan_file import (
    PlannedJob,
    load_plan,
    plan_document,
    planned_jobs,
    save_plan,
)
from mocapbench.benchmark.tasks.address import Address

JOBS = [PlannedJob(f"key {n}", "fit", Address("t", 1, "c", n, "label")) for n in range(3)]
WHOLE = plan_document(JOBS, provenance={"seed": "0"}, workers=2)


def test_jobs_come_back_in_order(tmp_path):
    save_plan(tmp_path, WHOLE)
    plan = load_plan(tmp_path)
    assert planned_jobs(plan) == JOBS
    assert plan == WHOLE


def test_a_plan_of_an_earlier_version_tells_no_jobs(tmp_path):
    save_plan(tmp_path, {"keys": ["a"], "provenance": {}})
    assert planned_jobs(load_plan(tmp_path)) == []


@pytest.mark.parametrize(
    "changes",
    [
        {"jobs": WHOLE["jobs"][:1]},
        {"jobs": [{}] * 3},
        {"jobs": [3] * 3},
        {"jobs": 3},
        {"workers": 0},
        {"workers": "two"},
        {"keys": None},
        {"provenance": []},
        {"runs": [3]},
        {"runs": ["a"]},
    ],
    ids=str,
)
def test_what_is_no_plan_is_refused(tmp_path, changes):
    (tmp_path / "plan.json").write_text(json.dumps({**WHOLE, **changes}))
    with pytest.raises(UsageError, match="is not a plan; run `mocapbench run` again"):
        load_plan(tmp_path)


def test_a_damaged_plan_says_what_to_do(store):
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        store.load_plan()
    for foreign in ("{}", "5", "[]", '{"keys": 3, "provenance": {}}'):
        (store.path / "plan.json").write_text(foreign)
        with pytest.raises(UsageError, match="is not a plan"):
            store.load_plan()
    (store.path / "plan.json").write_text("{")
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        store.load_plan()
