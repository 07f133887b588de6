"""The server of workers: it starts ahead of them, and computes with one thread."""

import os
import signal
import subprocess
import sys
import tempfile
import time

import psutil
import pytest
from hostile_folder import HostileFolder
from threadpoolctl import threadpool_info

from mocapbench import benchmark as bench
from mocapbench.basics.scratch import scratch_folder
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool


@pytest.fixture
def pool():
    """Return a worker, which starts with the first job."""
    workers = WorkerPool(1)
    yield workers
    workers.stop()


@pytest.mark.forks
def test_workers_come_from_the_server_that_was_started_ahead(pool):
    bench.worker_context()
    servers = {child.pid for child in psutil.Process().children()}
    bench.worker_context()
    assert {child.pid for child in psutil.Process().children()} == servers
    assert pool.submit(os.getppid).result() in servers


def test_workers_have_one_thread_and_this_process_keeps_its_environment(monkeypatch, pool):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    libraries = pool.submit(threadpool_info).result()
    asked = pool.submit(os.getenv, "OMP_NUM_THREADS").result()
    assert libraries
    assert {library["num_threads"] for library in libraries} == {1}
    assert asked == "1"
    assert os.environ["OPENBLAS_NUM_THREADS"] == "2"


@pytest.mark.forks
@pytest.mark.slow
def test_a_server_that_died_is_started_again_and_is_as_the_first(monkeypatch, tmp_path, pool):
    """It computes with one thread, and runs no file of the folder that it starts in."""
    hostile = HostileFolder(tmp_path / "sent", tmp_path / "marks")
    monkeypatch.chdir(hostile.path)
    server = pool.submit(os.getppid).result()
    other = WorkerPool(1)  # starts a worker with the first job
    os.kill(server, signal.SIGKILL)
    os.waitid(os.P_PID, server, os.WEXITED | os.WNOWAIT)
    try:
        assert other.submit(os.getppid).result() != server
        assert other.submit(os.getenv, "OMP_NUM_THREADS").result() == "1"
    finally:
        other.stop()
    assert hostile.run_files == []


def test_programs_that_a_model_starts_find_their_helpers(monkeypatch, tmp_path, pool):
    (tmp_path / "helper.py").write_text("print('found')")
    (tmp_path / "script.py").write_text("import helper")
    words = [sys.executable, str(tmp_path / "script.py")]
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    assert pool.submit(subprocess.check_output, words).result() == b"found\n"


@pytest.mark.forks
def test_a_server_that_is_loading_does_not_hear_of_an_interrupt():
    code = "import time; from mocapbench import benchmark as b; b.worker_context(); time.sleep(0.5)"
    with subprocess.Popen(
        [sys.executable, "-c", code], stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        while len(psutil.Process(process.pid).children()) < 2:  # the server beside the tracker
            time.sleep(0.01)
        time.sleep(0.2)
        os.killpg(process.pid, signal.SIGINT)
        complaint = process.communicate()[1]
    assert "KeyboardInterrupt" in complaint  # of the process that started the server
    assert "forkserver" not in complaint


START_ONE = """
import os, time
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool
if __name__ == "__main__":
    pool = WorkerPool(1)
    asked = pool.submit(os.getenv, "TMPDIR").result()
    print(asked, flush=True)
    time.sleep({seconds})
    pool.stop()
"""


@pytest.mark.slow
@pytest.mark.parametrize("is_killed", [True, False])
def test_what_processes_leave_lies_in_one_folder_which_the_next_start_deletes(
    tmp_path, tmp_path_factory, monkeypatch, is_killed
):
    program, temporary = tmp_path / "program.py", tmp_path_factory.mktemp("t")
    program.write_text(START_ONE.format(seconds=600 if is_killed else 0))
    monkeypatch.setenv("TMPDIR", str(temporary))
    with subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE, text=True) as process:
        folder = process.stdout.readline().strip()
        if is_killed:
            assert [str(path) for path in _list_folders(temporary)] == [folder]
            process.kill()
    assert len(_list_folders(temporary)) == is_killed
    monkeypatch.setattr(tempfile, "tempdir", None)
    with scratch_folder() as ours:
        assert _list_folders(temporary) == [ours]
    assert [*temporary.iterdir()] == []


def _list_folders(path):
    """Return what lies there but locks, which some systems have as files."""
    return [each for each in path.iterdir() if each.is_dir()]
