import json

import pytest

from mocapbench.benchmark.runs.plan_document import (
    PlannedJob,
    is_plan,
    plan_document,
    planned_jobs,
)
from mocapbench.benchmark.tasks.address import Address

JOBS = [PlannedJob(f"key {n}", "fit", Address("t", 1, "c", n, "label"), "") for n in range(3)]
WHOLE = plan_document(JOBS, provenance={"seed": "0"}, workers=2)


def test_jobs_come_back_in_order():
    plan = json.loads(json.dumps(WHOLE))
    assert is_plan(plan)
    assert planned_jobs(plan) == JOBS


@pytest.mark.parametrize("name", ["keys", "jobs", "provenance"])
def test_a_plan_has_keys_jobs_and_a_provenance(name):
    assert not is_plan({each: value for each, value in WHOLE.items() if each != name})


@pytest.mark.parametrize(
    "changes",
    [
        {"jobs": WHOLE["jobs"][:1]},
        {"jobs": []},
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
def test_what_is_no_plan_is_told(changes):
    assert not is_plan({**WHOLE, **changes})
