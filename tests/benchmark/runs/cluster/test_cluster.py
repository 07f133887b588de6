"""A run on a cluster has the results of a run on one machine, whatever befalls the workers."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
from distributed import Client, LocalCluster
from own_files import write_csv

pytestmark = pytest.mark.slow

TOY = ("run", "--offline", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--folds", 1)
MEASURED = {"fit_seconds", "predict_seconds", "peak_memory_mb", "provenance"}


def computed(records):
    """Return what of the records does not depend on when and where they were computed."""
    return {
        address: {name: value for name, value in record.items() if name not in MEASURED}
        for address, record in records.items()
    }


def predictions(out):
    """Return the arrays of every fit, by name."""
    fits = {}
    for path in (out / "predictions").rglob("*.npz"):
        with np.load(path) as arrays:
            fits[path.stem] = {name: arrays[name] for name in arrays.files if name != "about"}
    return fits


@pytest.fixture
def both(cli, records, scheduler, tmp_path):
    """Return a function that runs on a cluster, then alone, and returns the records of each."""

    def run(*request, code):
        clustered, alone = tmp_path / "clustered", tmp_path / "alone"
        assert cli(*request, "--scheduler", scheduler, "--out", clustered) == code, cli.printed
        assert cli(*request, "--jobs", 1, "--out", alone) == code, cli.printed
        return records(clustered), records(alone)

    return run


@pytest.fixture
def marker(tmp_path):
    """Return a path at which the meddling models leave a trace."""
    return tmp_path / "on a cluster"


@pytest.fixture
def meddling_models(tmp_path, marker):
    source = Path(__file__).with_name("meddling_models.py").read_text()
    plugin = tmp_path / "meddling_models.py"
    plugin.write_text(source.replace('"filled in"', repr(str(marker))))
    return plugin


def test_results_are_those_of_one_machine_though_a_worker_is_killed(
    both, meddling_models, marker, tmp_path
):
    request = (
        *("run", "--profile", "smoke", "--offline", "--plugin", meddling_models),
        *("--tasks", "toy-interpolation-1,toy-synthesis,missing-frames"),
        *("--models", "kills-once,knn,cubic-spline,mohgp,gp-independent,nn"),
    )
    clustered, alone = both(*request, code=0)
    assert marker.exists()
    assert {task for task, *_ in alone} == {
        *("toy-interpolation-1", "toy-synthesis", "missing-frames")
    }
    assert computed(clustered) == computed(alone)
    ours, theirs = predictions(tmp_path / "clustered"), predictions(tmp_path / "alone")
    assert ours.keys() == theirs.keys()
    for key, arrays in ours.items():
        assert arrays.keys() == theirs[key].keys()
        for name, values in arrays.items():
            np.testing.assert_array_equal(values, theirs[key][name])


def test_a_job_that_kills_every_worker_becomes_a_failed_record(
    cli, records, scheduler, meddling_models, tmp_path
):
    chosen = ("--plugin", meddling_models, "--models", "kills-always")
    assert cli(*TOY, *chosen, "--scheduler", scheduler, "--out", tmp_path / "run") == 3
    (record,) = records(tmp_path / "run").values()
    assert record["status"] == "failed"
    assert "4 workers died while they had the job" in record["message"]


@pytest.fixture
def asleep(scheduler, meddling_models, marker, tmp_path):
    """Return a run on the cluster, and the process and the plug-in's file of its sleeping job."""
    request = (*TOY, "--plugin", meddling_models, "--models", "sleeps-once")
    program = "from mocapbench.benchmark.cli.main import main; main()"
    arguments = (*request, "--scheduler", scheduler, "--out", tmp_path / "run")
    with subprocess.Popen([sys.executable, "-c", program, *map(str, arguments)]) as run:
        while not (marker.exists() and marker.read_text().endswith("\n")):
            assert run.poll() is None
            time.sleep(0.1)
        pid, file = marker.read_text().strip().split(" ", 1)
        yield run, psutil.Process(int(pid)), Path(file)


def test_an_interrupt_ends_what_runs_on_the_cluster(asleep, ends, tmp_path):
    run, sleeper, file = asleep
    assert file.exists()
    run.send_signal(signal.SIGINT)
    assert run.wait() == 130
    assert ends(sleeper)
    assert not file.exists()
    assert not any((tmp_path / "run" / "records").rglob("*.json"))


def test_a_run_that_is_killed_ends_on_the_cluster_too(asleep, ends):
    run, sleeper, file = asleep
    run.kill()
    assert ends(sleeper)
    latest = time.monotonic() + 60
    while file.exists() and time.monotonic() < latest:
        time.sleep(0.1)
    assert not file.exists()


def test_a_worker_that_leaves_hands_its_job_on(asleep, scheduler, records, ends, tmp_path):
    run, sleeper, _ = asleep
    with Client(scheduler) as client:
        leaving = [address for address, jobs in client.processing().items() if jobs]
        client.retire_workers(leaving)
    assert run.wait() == 0
    assert ends(sleeper)
    assert {record["status"] for record in records(tmp_path / "run").values()} == {"ok"}


PENDULUMS = Path(__file__).parents[4] / "examples" / "plugin" / "pendulums.py"
READING = "    def recording(self, key):\n"


@pytest.fixture
def unreadable_where(tmp_path):
    """Return a function that makes the example's recordings unreadable under a condition."""

    def make(condition):
        known = "    def digest(self, key):\n        return key\n\n"
        raising = f"        if {condition}:\n            raise OSError('no such disk')\n"
        source = PENDULUMS.read_text().replace(READING, f"{known}{READING}{raising}")
        plugin = tmp_path / "swings.py"
        plugin.write_text(f"import os\n{source}")
        return plugin

    return make


@pytest.mark.parametrize(
    ("condition", "code"),
    [(f"os.getpid() != {os.getpid()}", 0), ("True", 3)],
    ids=["here alone", "nowhere"],
)
def test_recordings_are_read_where_the_run_starts(both, unreadable_where, condition, code):
    """Where they cannot be read there, the record says why, as it does on one machine."""
    plugin = unreadable_where(condition)
    request = ("run", "--plugin", plugin, "--tasks", "pendulums", "--models", "linear-dynamics")
    clustered, alone = both(*request, code=code)
    found, expected = (
        {address: (r["status"], r["message"], r["scores"]) for address, r in run.items()}
        for run in (clustered, alone)
    )
    assert found == expected
    assert len(found) == 9


def test_a_worker_with_another_version_is_refused(cli, lone_worker, tmp_path):
    metadata = tmp_path / "path" / "scipy-0.1.dist-info" / "METADATA"
    metadata.parent.mkdir(parents=True)
    metadata.write_text("Metadata-Version: 2.1\nName: scipy\nVersion: 0.1\n")
    address = lone_worker(tmp_path / "path")
    assert cli(*TOY, "--scheduler", address, "--out", tmp_path / "run") == 2
    assert "expected scipy" in cli.printed
    assert "got 0.1; install the same there as here" in cli.printed


@pytest.fixture
def no_mocapbench(tmp_path):
    """Return a folder on whose path mocapbench cannot be imported."""
    package = tmp_path / "path" / "mocapbench"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("raise ModuleNotFoundError('no mocapbench here')")
    return package.parent


def test_a_worker_without_mocapbench_is_refused(cli, lone_worker, no_mocapbench, tmp_path):
    address = lone_worker(no_mocapbench)
    assert cli(*TOY, "--scheduler", address, "--out", tmp_path / "run") == 2
    assert f"worker {address.rsplit(':', 1)[0]}" in cli.printed
    assert "expected mocapbench as it is here, got ModuleNotFoundError" in cli.printed


def test_a_scheduler_without_mocapbench_is_refused(cli, scheduler, monkeypatch, tmp_path):
    def run_on_scheduler(*_):
        raise ModuleNotFoundError("no mocapbench here")

    monkeypatch.setattr(Client, "run_on_scheduler", run_on_scheduler)
    assert cli(*TOY, "--scheduler", scheduler, "--out", tmp_path / "run") == 2
    assert "the scheduler: expected mocapbench as it is here, got no mocapbench" in cli.printed


def test_a_scheduler_without_workers_is_refused(cli, monkeypatch, tmp_path):
    monkeypatch.setattr("mocapbench.benchmark.runs.cluster.admission._PATIENCE", 0.1)
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as cluster:
        out = ("--out", tmp_path / "run")
        assert cli(*TOY, "--scheduler", cluster.scheduler_address, *out) == 2
    assert "expected the scheduler to have a worker" in cli.printed


def test_own_recordings_travel_to_the_workers(both, tmp_path):
    folder, task_file = tmp_path / "recordings", tmp_path / "mine.toml"
    for name in ("a", "b"):
        write_csv(folder / f"{name}.csv")
    task_file.write_text('files = "*.csv"\nmodels = ["linear", "knn"]\n[hide]\nfraction = 0.2\n')
    request = ("run", "--offline", "--recordings", folder, "--task-file", task_file)
    clustered, alone = both(*request, code=0)
    assert len(alone) == 4
    assert computed(clustered) == computed(alone)
