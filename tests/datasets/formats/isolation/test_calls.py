"""A crash, a hang or a hunger for memory costs one call, and nothing else."""

import os
import signal
import subprocess
import sys

import numpy as np
import psutil
import pytest

from mocapbench.datasets.formats.isolation import calls
from mocapbench.datasets.formats.isolation.calls import IsolatedCallError, call_isolated

GOOD = {"timeout": 60.0, "memory": 2**28}


@pytest.fixture
def called(tmp_path, monkeypatch):
    """Return a function that calls one of a module of misbehaving functions."""
    (tmp_path / "misbehaving.py").write_text(
        "import ctypes, os, sys, time\n"
        "import numpy as np\n"
        "def pid():\n    return {'pid': np.array(os.getpid())}\n"
        "def double(text):\n    return {'twice': np.array(2 * text)}\n"
        "def fail():\n    raise RuntimeError('no such luck')\n"
        "def crash():\n    ctypes.string_at(0)\n"
        "def leave():\n    os._exit(3)\n"
        "def sleep():\n    time.sleep(600)\n"
        "def eat():\n    return {'much': np.ones(2**22)}\n"
        "def hoard():\n    much = np.ones(2**22)\n    time.sleep(10.0)\n    return {'much': much}\n"
        "def talk():\n"
        "    os.write(1, b'on the way out of answers'); print('more'); return {'one': np.ones(1)}\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    calls._process_of(os.getpid()).close()  # that of other tests does not see this module

    def called(name, *arguments, **limits):
        return call_isolated(f"misbehaving:{name}", *arguments, **{**GOOD, **limits})

    yield called
    calls._process_of(os.getpid()).close()


def test_it_answers_from_one_other_process(called):
    pid = int(called("pid")["pid"])
    assert pid != os.getpid()
    assert called("double", "kné")["twice"] == "knékné"
    assert int(called("pid")["pid"]) == pid


@pytest.mark.parametrize(
    ("name", "limits", "complaint"),
    [
        ("fail", {}, "RuntimeError: no such luck"),
        ("absent", {}, "AttributeError: .*absent"),
        ("crash", {}, rf"a crash of the library that reads it \(exit code -{signal.SIGSEGV:d}\)"),
        ("leave", {}, r"a crash of the library that reads it \(exit code 3\)"),
        ("sleep", {"timeout": 1.0}, "no end of reading it within 1 s"),
        # The portable backend looks now and then.
        ("hoard", {"memory": 2**22}, "content that takes more memory than a file of its size"),
    ],
)
def test_what_goes_wrong_is_said_and_the_next_call_works(called, name, limits, complaint):
    with pytest.raises(IsolatedCallError, match=complaint):
        called(name, **limits)
    assert called("double", "a")["twice"] == "aa"


@pytest.mark.forks  # the portable backend looks now and then, and misses what is soon over
def test_enough_memory_is_enough_also_after_too_little(called):
    with pytest.raises(IsolatedCallError):
        called("eat", memory=2**20)
    assert called("eat", memory=2**30)["much"].sum() == 2**22


def test_an_interrupted_call_leaves_no_answer_for_the_next(called, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(calls, "_exactly", interrupted)
        with pytest.raises(KeyboardInterrupt):
            called("double", "a")
    assert called("double", "b")["twice"] == "bb"


def test_crashes_leave_no_open_files(called):
    called("pid")
    before = psutil.Process().num_fds()
    for _ in range(3):
        with pytest.raises(IsolatedCallError):
            called("leave")
    called("pid")
    assert psutil.Process().num_fds() == before


def test_what_a_library_prints_is_no_answer(called):
    assert np.array_equal(called("talk")["one"], [1.0])


def test_a_fork_gets_a_process_of_its_own(called):
    mine = int(called("pid")["pid"])
    read, write = os.pipe()
    if (child := os.fork()) == 0:
        os.write(write, str(int(called("pid")["pid"])).encode())
        os._exit(0)
    os.waitpid(child, 0)
    assert int(os.read(read, 20)) != mine
    assert int(called("pid")["pid"]) == mine


def test_it_ends_with_the_process_that_started_it(called):
    script = (
        "from mocapbench.datasets.formats.isolation.calls import call_isolated\n"
        "print(call_isolated('misbehaving:pid', timeout=60.0, memory=2**28)['pid'])\n"
    )
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    pid = int(done.stdout)
    if psutil.pid_exists(pid):
        psutil.Process(pid).wait(timeout=30)
    assert not psutil.pid_exists(pid)
