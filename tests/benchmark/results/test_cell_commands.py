"""The command of a cell, which computes this cell alone with the same keys."""

import shlex
import subprocess
import sys
from dataclasses import replace

import pytest
from typer.main import get_command

from mocapbench.benchmark import TASKS, Request, archive_at, plan
from mocapbench.benchmark.cli import run as run_module
from mocapbench.benchmark.results.origins import FLAGS, LEFT_OUT, cell_command, origins
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

KEPT = {
    *("--metrics", "--data-dir", "--recordings", "--task-file", "--plugin", "--model-file"),
    *("--timeout", "--memory"),
}


def record(case="test 1", fold=0, label="knn", **provenance):
    address = Address("toy-interpolation-1", 1, case, fold, label)
    return Record(f"{fold:064x}", "", address, 7, label, {}, Status.OK, provenance=provenance)


def options():
    return [p for p in get_command(run_module.app).params if p.name != "help"]


def test_every_option_of_run_is_either_kept_or_left_out():
    names = {name for option in options() for name in option.opts}
    assert names == KEPT | LEFT_OUT
    assert {name for o in options() if o.is_flag for name in o.opts} == FLAGS


def test_it_takes_from_the_command_line_what_the_keys_depend_on():
    line = (
        "mocapbench run --profile smoke --plugin 'my models.py' --metrics=mse --offline "
        "--jobs 2 --out x --seed 3 --folds 9 --explain"
    )
    command = cell_command(
        [record(fold=f, profile="smoke", **{"command line": line}) for f in (1, 0)]
    )
    assert " ".join(command) == (
        "mocapbench run --profile smoke --seed 7 --plugin 'my models.py' --metrics=mse "
        "--tasks toy-interpolation-1 --cases 'test 1' --models knn --folds 2 --out mocapbench-cell"
    )


@pytest.mark.parametrize("line", ["", "mocapbench merge a b", "python -c pass", "mocapbench"])
def test_another_program_gives_no_options(line):
    assert len(cell_command([record(**{"command line": line})])) == 5


@pytest.mark.parametrize("task", TASKS.names())
def test_the_shell_gives_the_jobs_of_the_cell_and_no_other(task):
    profiles = [name for name in ("smoke", "quick", "paper") if name in TASKS.get(task).profiles]
    archive, request = archive_at(), Request(profiles[0], tasks=(task,))
    cells = {}
    for job in plan(request, archive):
        cells.setdefault((job.address.case, job.address.label), []).append(job)
    one_a_label = {label: cell for cell in cells for label in cell[1:]}.values()
    one_a_case = {case: (case, label) for case, label in cells}.values()
    for cell in {*one_a_label, *one_a_case}:
        assert [job.key for job in replanned(cells[cell], profiles[0], archive)] == [
            job.key for job in cells[cell]
        ]


def replanned(jobs, profile, archive):
    records = [replace(job.record(Status.OK), provenance={"profile": profile}) for job in jobs]
    words = shlex.split(" ".join(cell_command(records)))
    given = get_command(run_module.app).make_context("run", words[2:]).params
    names = {n: run_module.split(given[n]) for n in ("tasks", "cases", "models", "metrics")}
    request = Request(given["profile"], **names, folds=given["folds"], seed=given["seed"])
    return plan(request, archive)


@pytest.mark.slow
def test_the_command_computes_the_cell_again_with_the_same_keys_and_scores(tmp_path):
    run = "mocapbench run --profile smoke --tasks marker-gaps --models hold,linear --folds 1"
    program = [sys.executable, "-m", "mocapbench.benchmark.cli.main"]
    case = ["--cases", "synthetic a limb 0.5 s? others*"]
    subprocess.run(
        [*program, *shlex.split(run)[1:], *case, "--out", str(tmp_path / "whole")],
        check=True,
        cwd=tmp_path,
        capture_output=True,
    )
    whole = RunDirectory(tmp_path / "whole").planned()
    assert len(whole) == 2
    ((_, origin),) = [each for each in origins(whole).items() if each[0][2] == "linear"]
    command = " ".join(origin.command).replace("mocapbench ", f"{shlex.join(program)} ", 1)
    subprocess.run(command, shell=True, check=True, cwd=tmp_path, capture_output=True)
    (alone,) = RunDirectory(tmp_path / "mocapbench-cell").planned()
    (twin,) = [record for record in whole if record.address.label == "linear"]
    assert {0: alone.key} == origin.keys
    assert alone.scores == twin.scores
    assert alone.provenance["seed"] == twin.provenance["seed"]
