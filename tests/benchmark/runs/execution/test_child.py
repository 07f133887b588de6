"""A call in a process of its own: what it returns, and how it ends if it does not return."""

import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import psutil
import pytest

from mocapbench.basics.child import ProcessDiedError, call_in_child

pytestmark = pytest.mark.forks


def _square(number):
    return number**2


def _change_everything(folder):
    np.random.seed(1)  # noqa: NPY002
    np.seterr(all="raise")
    os.environ["MOCAPBENCH_TEST"] = "changed"
    os.chdir(folder)
    resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64))
    np.zeros = None


def _state():
    return (
        np.random.get_state()[1].tolist(),  # noqa: NPY002
        np.geterr(),
        os.environ.get("MOCAPBENCH_TEST"),
        Path.cwd(),
        resource.getrlimit(resource.RLIMIT_NOFILE),
        np.zeros,
    )


def _peak(megabytes):
    hoard = np.ones(megabytes * 2**17)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 + 0 * hoard[0]


def _start_one_that_holds_the_pipe(file):
    pid = os.fork()
    if pid == 0:
        time.sleep(600)
    Path(file).write_text(str(pid))
    os._exit(3)


def _sleep():
    time.sleep(600)


def _close_everything_and_sleep():
    os.closerange(3, 4096)
    time.sleep(600)


def _raise():
    raise ValueError("not as promised")


def _what_cannot_be_pickled():
    return lambda: None


@pytest.mark.parametrize("number", [3, 10**6])
def test_it_returns_what_the_function_returns(number):
    assert call_in_child(_square, number, timeout=60) == number**2


def test_a_large_result_comes_back_whole():
    assert call_in_child(np.arange, 10**6, timeout=60).sum() == 10**6 * (10**6 - 1) // 2


def test_what_it_changes_ends_with_it(tmp_path):
    before = _state()
    call_in_child(_change_everything, tmp_path, timeout=60)
    assert _state() == before


def test_its_peak_memory_is_its_own():
    small, large = (call_in_child(_peak, megabytes, timeout=60) for megabytes in (1, 300))
    again = call_in_child(_peak, 1, timeout=60)
    assert large - small > 200
    assert abs(again - small) < 50


@pytest.mark.parametrize("code", [0, 7, 255])
def test_an_exit_without_a_result_tells_the_code(code):
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(os._exit, code, timeout=60)
    assert raised.value.exit_code == code


def test_a_kill_tells_the_signal():
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(signal.raise_signal, signal.SIGKILL, timeout=60)
    assert raised.value.exit_code == -signal.SIGKILL


def test_a_descendant_that_holds_the_pipe_does_not_keep_it_waiting(tmp_path):
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(_start_one_that_holds_the_pipe, tmp_path / "pid", timeout=60)
    os.kill(int((tmp_path / "pid").read_text()), signal.SIGKILL)
    assert raised.value.exit_code == 3


@pytest.mark.parametrize("function", [_sleep, _close_everything_and_sleep])
def test_it_is_killed_after_the_timeout(function):
    """Even if it lives on without a way to report; of others' processes nothing is assumed."""
    before = {*psutil.Process().children()}
    with pytest.raises(TimeoutError):
        call_in_child(function, timeout=0.5)
    assert not {*psutil.Process().children()} - before


@pytest.mark.parametrize("function", [_raise, _what_cannot_be_pickled], ids=["raises", "lambda"])
def test_one_that_breaks_its_promise_dies_and_says_why(function, capfd):
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(function, timeout=60)
    assert raised.value.exit_code == 1
    assert "Traceback" in capfd.readouterr().err


def test_what_waits_to_be_printed_is_printed_once():
    program = (
        "from mocapbench.basics.child import call_in_child\n"
        "print('before')\n"
        "call_in_child(print, 'in it', timeout=60)\n"
        "print('after')\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert ended.stdout.split(b"\n") == [b"before", b"in it", b"after", b""]


LEFT_BEHIND = """
import os, pathlib, subprocess, sys
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.child import call_in_child
def work():
    shell = f"sleep 600 & echo $! >> {sys.argv[1]}; echo $$ >> {sys.argv[1]}; wait"
    subprocess.Popen(["sh", "-c", shell])
    while len(pathlib.Path(sys.argv[1]).read_text().split()) < 2:
        pass
pathlib.Path(sys.argv[1]).touch()
find_system().become_worker()
call_in_child(work, timeout=60)
find_system().kill_children()
"""


def test_what_it_leaves_running_is_found_and_killed(tmp_path):
    subprocess.run([sys.executable, "-c", LEFT_BEHIND, tmp_path / "pids"], check=True, timeout=60)
    left = list(map(int, (tmp_path / "pids").read_text().split()))
    assert len(left) == 2
    assert not [pid for pid in left if psutil.pid_exists(pid)]


@pytest.mark.slow
def test_it_ends_with_the_process_that_waits_for_it(tmp_path):
    """However that ends: a killed worker must leave nothing that computes on."""
    file = tmp_path / "pid"
    program = (
        "import os, pathlib, time\n"
        "from mocapbench.basics.child import call_in_child\n"
        "def work():\n"
        f"    pathlib.Path({str(file)!r}).write_text(str(os.getpid()))\n"
        "    time.sleep(600)\n"
        "call_in_child(work, timeout=600)\n"
    )
    parent = subprocess.Popen([sys.executable, "-c", program])
    while not (file.is_file() and file.read_text()):
        assert parent.poll() is None
        time.sleep(0.05)
    child = psutil.Process(int(file.read_text()))
    parent.kill()
    parent.wait()
    child.wait(timeout=60)
    assert not child.is_running()


RUN = """
import multiprocessing, os, sys, time
from mocapbench.basics.child import call_in_child

def sleep():
    print(os.getpid(), flush=True)
    time.sleep(600)

def work():
    print(os.getpid(), flush=True)
    call_in_child(sleep, timeout=600)

if __name__ == "__main__":
    multiprocessing.get_context("forkserver").Process(target=work).start()
"""
"""A worker's parent, by the system's reckoning, is the server that forked it, and not the run."""


def test_workers_and_their_calls_end_when_the_process_that_started_them_is_killed(ends, tmp_path):
    script = tmp_path / "run.py"
    script.write_text(RUN)
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as run:
        worker, child = (psutil.Process(int(run.stdout.readline())) for _ in range(2))
        run.kill()
    assert ends(worker)
    assert ends(child)
