"""Laws of every backend: how a call in a child ends, and what its limits and locks are."""

import os
import subprocess
import sys
import time

import psutil
import pytest
from child_calls import (
    measure_peak,
    read_registered,
    register,
    start_another,
    take,
    wait_in_vain,
    work,
)
from filelock import FileLock

from mocapbench.basics.child import ProcessDiedError, call_in_child
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.temporaries import PREFIX, sweep, temporary_file, temporary_folder

MEBIBYTE = 2**20


@pytest.fixture(params=["linux", "portable"])
def backend(request, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_BACKEND", request.param)
    return request.param


@pytest.mark.usefixtures("backend")
def test_a_call_has_a_process_of_its_own_in_which_all_is_registered():
    register()
    process, registered = call_in_child(read_registered, timeout=60, prepare=register)
    assert process != os.getpid()
    assert registered == ["registered"]


@pytest.mark.usefixtures("backend")
@pytest.mark.parametrize("code", [0, 7])
def test_an_exit_without_a_result_tells_the_code(code):
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(os._exit, code, timeout=60)
    assert raised.value.exit_code == code


@pytest.mark.usefixtures("backend")
def test_a_call_is_stopped_after_its_time_and_nothing_of_it_is_left():
    before = {*psutil.Process().children(recursive=True)}
    with pytest.raises(TimeoutError):
        call_in_child(time.sleep, 600, timeout=0.5)
    left = {*psutil.Process().children(recursive=True)} - before
    assert [process for process in left if process.is_running()] == []


@pytest.mark.usefixtures("backend")
@pytest.mark.parametrize(("mebibytes", "got"), [(1, "1"), (400, "too much")])
def test_memory_is_limited(mebibytes, got):
    assert call_in_child(take, mebibytes, timeout=60) == got


@pytest.mark.usefixtures("backend")
def test_the_peak_of_a_call_is_its_own():
    large, small = (call_in_child(measure_peak, size, timeout=60) for size in (300, 1))
    assert 200 * MEBIBYTE < large - small < 400 * MEBIBYTE


@pytest.mark.usefixtures("backend")
def test_who_works_too_long_is_ended_and_it_is_known_why():
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(work, 1, timeout=60)
    assert find_system().is_end_of_work(raised.value.exit_code)
    assert not find_system().is_end_of_time(raised.value.exit_code)


@pytest.mark.usefixtures("backend")
def test_who_waits_too_long_is_ended_and_it_is_known_why():
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(wait_in_vain, 0.2, timeout=60)
    assert find_system().is_end_of_time(raised.value.exit_code)
    assert not find_system().is_end_of_work(raised.value.exit_code)


def test_what_a_call_leaves_running_is_killed(tmp_path, monkeypatch):
    """Linux leaves that to the worker."""
    monkeypatch.setenv("MOCAPBENCH_BACKEND", "portable")
    call_in_child(start_another, tmp_path / "pid", timeout=60)
    assert not psutil.pid_exists(int((tmp_path / "pid").read_text()))


KILLED = """
import os, pathlib, sys, time
from mocapbench.basics.child import call_in_child
def work():
    pathlib.Path(sys.argv[1]).write_text(str(os.getpid()))
    time.sleep(600)
if __name__ == "__main__":
    call_in_child(work, timeout=600)
"""


@pytest.mark.usefixtures("backend")
def test_a_call_ends_with_the_process_that_waits_for_it(tmp_path):
    script, file = tmp_path / "script.py", tmp_path / "pid"
    script.write_text(KILLED)
    waiting = subprocess.Popen([sys.executable, script, file])
    while not (file.is_file() and file.read_text()):
        assert waiting.poll() is None
        time.sleep(0.05)
    child = psutil.Process(int(file.read_text()))
    waiting.kill()
    waiting.wait()
    child.wait(timeout=60)
    assert not child.is_running()


@pytest.mark.parametrize("sweeper", ["linux", "portable"])
def test_what_is_in_use_is_not_swept_whoever_sweeps(backend, sweeper, tmp_path, monkeypatch):
    with temporary_folder(tmp_path) as folder, temporary_file(tmp_path) as file:
        (folder / "kept").touch()
        monkeypatch.setenv("MOCAPBENCH_BACKEND", sweeper)
        sweep(tmp_path)
        assert (folder / "kept").exists()
        assert file.exists()
        monkeypatch.setenv("MOCAPBENCH_BACKEND", backend)
    assert [*tmp_path.iterdir()] == []


LEAVE = """
import os, sys
from contextlib import ExitStack
from pathlib import Path
from mocapbench.basics.temporaries import temporary_file, temporary_folder
with temporary_folder(Path(sys.argv[1])), temporary_file(Path(sys.argv[1])):
    os._exit(0)
"""


@pytest.mark.usefixtures("backend")
def test_what_a_killed_process_left_is_swept(tmp_path):
    subprocess.run([sys.executable, "-c", LEAVE, tmp_path], check=True)
    assert {path.name.startswith(PREFIX) for path in tmp_path.iterdir()} == {True}
    sweep(tmp_path)
    assert [*tmp_path.iterdir()] == []


@pytest.mark.usefixtures("backend")
def test_a_lock_is_held_as_long_as_somebody_holds_it(tmp_path):
    lock = tmp_path / "lock"
    assert not find_system().is_held(lock)
    with FileLock(lock):
        assert find_system().is_held(lock)
    assert not find_system().is_held(lock)
