"""A call in a process of its own ends with whoever waits for it."""

import os
import subprocess
import sys
import time

import psutil
import pytest

from mocapbench.benchmark.runs.execution.child import ProcessDiedError, call_in_child

RUN = """
import multiprocessing, os, sys, time
from mocapbench.benchmark.runs.execution.child import call_in_child

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


def test_a_result_comes_back():
    assert call_in_child(divmod, 7, 2, timeout=60) == (3, 1)


def test_a_death_is_told_with_its_exit_code():
    with pytest.raises(ProcessDiedError) as died:
        call_in_child(os._exit, 7, timeout=60)
    assert died.value.exit_code == 7


def test_a_call_that_takes_too_long_is_ended():
    with pytest.raises(TimeoutError):
        call_in_child(time.sleep, 600, timeout=0.1)


def test_workers_and_their_calls_end_when_the_process_that_started_them_is_killed(ends, tmp_path):
    script = tmp_path / "run.py"
    script.write_text(RUN)
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as run:
        worker, child = (psutil.Process(int(run.stdout.readline())) for _ in range(2))
        run.kill()
    assert ends(worker)
    assert ends(child)
