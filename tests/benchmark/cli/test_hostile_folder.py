"""No command runs Python files of the folder in which it is given."""

import os
import subprocess
import sys

import format_files
import pytest
from distributed import LocalCluster
from hostile_folder import HostileFolder, write_program
from own_files import write_csv

pytestmark = pytest.mark.slow

SMOKE = ("run", "--offline", "--profile", "smoke", "--folds", "1")
TOY = (*SMOKE, "--tasks", "toy-interpolation-1", "--models", "trivial,linear")


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    base = tmp_path_factory.mktemp("hostile")
    return HostileFolder(base / "sent", base / "marks")


@pytest.fixture(scope="module")
def environment():
    """Return an environment that asks Python for nothing."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


@pytest.fixture(scope="module")
def give(hostile, environment, tmp_path_factory):
    """Return a function that gives a command in the hostile folder."""
    program = write_program(tmp_path_factory.mktemp("installed") / "bin")

    def give(*arguments, code=0):
        hostile.forget()
        done = subprocess.run(
            [sys.executable, str(program), *map(str, arguments)],
            cwd=hostile.path,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        assert hostile.run_files == []
        assert done.returncode == code, done.stdout + done.stderr

    return give


def test_python_itself_runs_them_where_nothing_is_done_about_it(environment, tmp_path):
    """Else the tests here would prove nothing."""
    hostile = HostileFolder(tmp_path / "sent", tmp_path / "marks")
    words = [sys.executable, "-c", "import numpy"]
    subprocess.run(words, cwd=hostile.path, env=environment, check=False, capture_output=True)
    assert hostile.run_files == ["numpy"]


@pytest.mark.parametrize("kind", ["csv", "parquet", "bvh", "c3d"])
def test_fill(give, hostile, kind):
    made = format_files.markers() if kind == "c3d" else format_files.walk()
    write = getattr(format_files, f"write_{kind}")
    write(hostile.path / f"walk.{kind}", made if kind == "bvh" else format_files.with_gap(made))
    gap = ("--frames", "20:30") if kind == "bvh" else ()
    give("fill", f"walk.{kind}", "--model", "linear", "--out", f"filled-{kind}", *gap)


@pytest.mark.slow
def test_commands_that_read_runs(give, hostile):
    give(*TOY, "--out", "run")
    give(*SMOKE, "--tasks", "toy-interpolation-2", "--models", "linear", "--out", "other")
    give("status", "run")
    give("merge", "run", "other", "--out", "both")
    give("report", "--out", "run")
    give("check", "run", "--reference", "reference.csv", "--update")
    give("check", "run", "--reference", "reference.csv")
    give("compare", "run", "run")
    give("export", "run")


@pytest.mark.slow
def test_commands_that_read_recordings_or_nothing(give, hostile):
    for name in ("a", "b"):
        write_csv(hostile.path / "walks" / f"{name}.csv")
    give("init", "mine.toml", "--recordings", "walks")
    give("run", "--dry-run", "--offline", "--recordings", "walks", "--task-file", "mine.toml")
    give("list", "models")
    give("list", "tasks", "--json")
    give("data", "status", "35_03")
    give("info")
    give("--help")


def test_a_cluster_that_is_started_for_a_run(give):
    give(*TOY, "--cluster", "local:1", "--out", "on-cluster")


RESTART = """
import os, signal
from mocapbench.benchmark.runs.cluster.local import open_backend

def kill(dask_worker):
    os.kill(os.getpid(), signal.SIGKILL)

if __name__ == "__main__":
    with open_backend("local:1") as backend:
        (first,) = backend._client.run(os.getpid).values()
        backend._client.run(kill, on_error="ignore")
        later = first
        while later == first:
            (later,) = [*backend._client.run(os.getpid, on_error="ignore").values()] or [first]
"""


def test_a_worker_that_is_started_again(hostile, environment, tmp_path):
    program = tmp_path / "restart.py"
    program.write_text(RESTART)
    hostile.forget()
    words = [sys.executable, str(program)]
    subprocess.run(words, cwd=hostile.path, env=environment, check=True, capture_output=True)
    assert hostile.run_files == []


@pytest.fixture
def scheduler(hostile, environment, tmp_path):
    """Return the address of a scheduler, whose worker was started in the hostile folder."""
    program = write_program(tmp_path / "bin", "distributed.cli.dask_worker")
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as cluster:
        worker = subprocess.Popen(
            [sys.executable, program, cluster.scheduler_address, "--no-nanny", "--no-dashboard"],
            cwd=hostile.path,
            env=environment,
            stderr=subprocess.DEVNULL,
        )
        yield cluster.scheduler_address
        worker.kill()
        worker.wait()


def test_a_cluster_that_is_there_already(give, scheduler):
    give(*TOY, "--scheduler", scheduler, "--out", "on-scheduler")


LOADED_LATER = ("numpy", "psutil", "typer", "rich", "random", "socket", "multiprocessing")
"""Python itself may load others before any program of ours begins."""


@pytest.mark.parametrize(
    ("path", "is_searched"),
    [(":", False), (":/mine", False), ("/mine:", False), ("/mine", False), (".:", True)],
)
def test_an_empty_entry_of_the_search_path_does_not_stand_for_the_current_folder(
    environment, tmp_path, path, is_searched
):
    sent = tmp_path / "sent"
    sent.mkdir()
    for name in LOADED_LATER:
        (sent / f"{name}.py").write_text("import os\nos.write(1, b'run')\nos._exit(1)\n")
    write_csv(sent / "walk.csv", gaps=[(20, 26, 0)])
    program = write_program(tmp_path / "bin")
    words = [sys.executable, program, "fill", "walk.csv", "--model", "linear"]
    done = subprocess.run(
        words,
        cwd=sent,
        env={**environment, "PYTHONPATH": path},
        stdout=subprocess.PIPE,
        check=False,
    )
    assert done.stdout.startswith(b"run") == is_searched
    assert (done.returncode == 0) != is_searched
