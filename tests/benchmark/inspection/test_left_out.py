"""What the run before had and this one has not is named, if it had results."""

from types import SimpleNamespace

import pytest

from mocapbench.benchmark.inspection.left_out import left_out_lines
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.tasks.address import Address

ROWS = [("t", case, label, fold) for case in "ab" for label in "xyz" for fold in (0, 1)]


def _jobs(rows):
    return [
        SimpleNamespace(address=Address(task, 2, case, fold, label))
        for task, case, label, fold in rows
    ]


@pytest.mark.parametrize(
    ("kept", "said"),
    [
        (ROWS, None),
        (ROWS[2:], "2 results of the run before (2 others)"),
        (
            [("t", "a", "x", 0)],
            "11 results of the run before (models y, z; case b; 1 other)",
        ),
        ([("u", "a", "x", 0)], "12 results of the run before (models y, z; task t)"),
        ([*ROWS, ("u", "a", "w", 0)], None),
    ],
)
def test_models_tasks_cases_and_folds_that_are_gone_are_named(write_run, tmp_path, kept, said):
    lines = left_out_lines(RunDirectory(write_run(tmp_path / "run", ROWS)), _jobs(kept))
    assert len(lines) == (said is not None)
    assert all(said in line for line in lines)


def test_jobs_without_a_result_are_not_missed(write_run, tmp_path):
    store = RunDirectory(write_run(tmp_path / "run", ROWS, left=ROWS[:2]))
    assert left_out_lines(store, _jobs(ROWS[2:])) == []


def test_a_new_folder_has_nothing_to_leave_out(tmp_path):
    assert left_out_lines(RunDirectory.create(tmp_path / "run"), _jobs(ROWS)) == []
