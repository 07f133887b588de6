import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark import TASKS, Seeds, archive_at
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.runs import keys
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.plan_document import PlannedJob, plan_document
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.source_code import digest, own_code, reading
from mocapbench.benchmark.tasks.address import Address


class CommandLine:
    """Runs the command line in this process and keeps what it printed."""

    def __init__(self, capsys):
        self.capsys = capsys
        self.printed = ""

    def __call__(self, *arguments):
        """Return the exit code."""
        self.capsys.readouterr()
        with pytest.raises(SystemExit) as ended:
            main([str(argument) for argument in arguments])
        captured = self.capsys.readouterr()
        self.printed = " ".join((captured.out + captured.err).split())
        assert "Traceback" not in self.printed
        return int(ended.value.code or 0)


@pytest.fixture
def cli(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    return CommandLine(capsys)


@pytest.fixture
def nothing_here(monkeypatch, tmp_path):
    """Hide the recordings of this machine."""
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))


@pytest.fixture(scope="session")
def posed():
    """Return a function that poses the problem of a case."""

    def pose(task, case, fold=0):
        task = TASKS.get(task)
        case = task.case(case)
        address = Address(task.name, task.version, case.problem_name, fold)
        return case.problem(Seeds(0, address), archive_at())

    return pose


@pytest.fixture
def broken_models():
    return Path(__file__).with_name("broken_models.py")


@pytest.fixture
def broken_metrics():
    return Path(__file__).with_name("broken_metrics.py")


def _records(out):
    documents = [json.loads(p.read_text()) for p in (Path(out) / "records").rglob("*.json")]
    return {(d["task"], d["case"], d["label"], d["fold"]): d for d in documents}


@pytest.fixture
def records():
    """Return a function from a run directory to its records, by address."""
    return _records


@pytest.fixture
def forget():
    """Return a function after which digests are computed anew, as in a fresh process."""

    def forget():
        for module in (digest, reading, own_code, keys):
            for value in vars(module).values():
                if hasattr(value, "cache_clear"):
                    value.cache_clear()

    forget()
    yield forget
    forget()


def _digest(*names):
    return hashlib.sha256(repr(names).encode()).hexdigest()


def _job(row, parts):
    task, case, label, fold = row
    key, fit_key = _digest(row, sorted(parts.items())), _digest("fit", row)
    return PlannedJob(key, fit_key, Address(task, 1, case, fold, label), "")


def _write_run(path, rows, *, statuses=None, scores=None, parts=None, left=(), seconds=1.0):
    """Write a run of rows (task, case, label, fold), as a run of the command line would."""
    store, parts = RunDirectory.create(path), parts or {"seed": "0"}
    jobs = {row: _job(row, parts) for row in rows}
    for row, job in jobs.items():
        if row in left:
            continue
        status = (statuses or {}).get(row, Status.OK)
        scored = {"mse": (scores or {}).get(row, float(len(row[1])))} if status is Status.OK else {}
        store.save(
            Record(
                *(job.key, job.fit_key, job.address, 0, job.address.label, {}, status),
                message="" if status is Status.OK else f"by {path.name}",
                scores=scored,
                fit_seconds=seconds if scored else None,
            )
        )
        if scored:
            store.save_fit(job.fit_key, Fit({"mean-0": np.ones((2, 2))}, seconds, 0, 1, 1, True))
    store.keep_keys({job.key: (job.address, parts) for job in jobs.values()})
    about = {"profile": "smoke", "seed": "0", "started": f"when {path.name} started"}
    store.save_plan(plan_document(jobs.values(), provenance=about, workers=2))
    return path


@pytest.fixture
def write_run():
    """Return a function that writes a run directory."""
    return _write_run
