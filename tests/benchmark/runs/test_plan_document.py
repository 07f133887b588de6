import json

import pytest

from mocapbench.benchmark.foreign_files import ForeignFileError, encode_json
from mocapbench.benchmark.runs.plan_document import (
    PlannedJob,
    plan_document,
    planned_jobs,
    planned_task_files,
    read_plan,
)
from mocapbench.benchmark.task_files.task_file import TaskFile
from mocapbench.benchmark.tasks.address import Address

JOBS = [PlannedJob(f"key {n}", "fit", Address("t", 1, "c", n, "label"), "") for n in range(3)]
WHOLE = plan_document(JOBS, provenance={"seed": "0"}, workers=2)


@pytest.fixture
def read(tmp_path):
    """Return a function that writes a document, and reads it as a plan."""

    def read(document):
        path = tmp_path / "plan.json"
        path.write_bytes(encode_json(document))
        return read_plan(path)

    return read


def test_jobs_come_back_in_order(read):
    assert planned_jobs(read(WHOLE)) == JOBS


def test_task_files_come_back(read):
    files = TaskFile("a.toml", 'files = "*"', "/data", ("a.csv",), (), complete=True, meets=("x",))
    assert planned_task_files(read({**WHOLE, "task_files": [files]})) == (files,)


def test_bytes_that_are_not_utf_8_in_the_command_line_are_kept_escaped(read):
    plan = {**WHOLE, "provenance": {"command line": "mocapbench run --out T\udcea"}}
    assert read(plan)["provenance"]["command line"] == "mocapbench run --out T\\udcea"


@pytest.mark.parametrize("name", ["keys", "jobs", "provenance"])
def test_a_plan_has_keys_jobs_and_a_provenance(read, name):
    with pytest.raises(ForeignFileError, match=f"expected the entry {name}"):
        read({each: value for each, value in WHOLE.items() if each != name})


ROW = WHOLE["jobs"][0]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"jobs": WHOLE["jobs"][:1]}, "expected a key for each job, got 3 for 1"),
        ({"jobs": [WHOLE["jobs"][0]] * 3}, "expected each job once, got t · c · label · fold 1 tw"),
        ({"jobs": []}, "expected a key for each job"),
        ({"jobs": [{}] * 3}, r"at jobs\[0\], expected the entry"),
        ({"jobs": [3] * 3}, r"at jobs\[0\], expected a table, got a whole number"),
        ({"jobs": 3}, "at jobs, expected a list"),
        ({"jobs": [ROW, ROW, {**ROW, "fold": 10**25}]}, r"at jobs\[2\].fold, expected a whole"),
        ({"jobs": [ROW, ROW, {**ROW, "fit_key": "a/b"}]}, r"at jobs\[2\].fit_key"),
        ({"workers": 0}, "at workers, expected a whole number >= 1"),
        ({"workers": "two"}, "at workers"),
        ({"keys": None}, "at keys"),
        ({"keys": ["../up", "b", "c"]}, r"at keys\[0\]"),
        ({"provenance": []}, "at provenance"),
        ({"provenance": {"profile": ["quick"]}}, r"at provenance\[...\]"),
        ({"runs": [3]}, r"at runs\[0\]"),
        ({"runs": ["a"]}, r"at runs\[0\]"),
        ({"task_files": [{"file": "a.toml"}]}, r"at task_files\[0\], expected the entry text"),
        ({"drawn": 3}, "at drawn"),
    ],
    ids=str,
)
def test_what_is_no_plan_is_told_with_its_place(read, changes, said):
    with pytest.raises(ForeignFileError, match=f"plan.json: expected a plan; .*{said}.*run` again"):
        read(json.loads(json.dumps({**WHOLE, **changes})))
