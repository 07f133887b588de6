"""A program that fails costs a message: what was expected, what was got, and what it said."""

import os
import resource
import signal
import subprocess
import sys
import time
from functools import partial

import psutil
import pytest
from limited_programs import (
    reserve_addresses,
    run_script,
    run_with_deadline,
    take_memory,
    work_in_vain,
)

from mocapbench.basics.child import ProcessDiedError, call_in_child
from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.programs.running import ProgramError, run_program

SECOND_LIMIT = """
import resource, sys
from pathlib import Path
from mocapbench.benchmark.programs.running import run_program
run_program(["sh", "-c", "echo $$ > pid; sleep 603"], Path(), Path(sys.argv[1]), {})
"""


@pytest.fixture
def shell(tmp_path):
    """Return a function that runs a script of a shell in the folder of a test."""
    return partial(run_script, tmp_path)


def test_it_gets_its_arguments_its_folder_and_its_variables(shell, tmp_path):
    shell('echo "$1 $2 $(pwd) $WHICH" > told', WHICH="this")
    assert (tmp_path / "told").read_text() == f"fill {tmp_path}/f {tmp_path} this\n"


def test_what_it_prints_is_lost_and_nothing_is_to_be_read(shell):
    assert shell("cat; head -c 1000000 /dev/zero; echo warned >&2") == "; it said: warned"


@pytest.mark.parametrize(
    ("script", "got"),
    [
        ("echo no licence >&2; exit 3", "got 3; it said: no licence"),
        ("exit 3", "got 3; it said nothing on standard error"),
        ("kill -SEGV $$", "got its end by SIGSEGV; it said nothing"),
        ("seq 100000 >&2; exit 1", "got 1; it said: 99996 | 99997 | 99998 | 99999 | 100000"),
        (r"printf '\033[31mred\377\n' >&2; exit 1", "got 1; it said: red"),
    ],
)
def test_another_exit_code_than_0_is_told_with_its_last_lines(shell, script, got):
    with pytest.raises(ProgramError) as raised:
        shell(script)
    assert "fill FOLDER` to end with exit code 0, " in str(raised.value)
    assert got in str(raised.value)


@pytest.mark.parametrize("word", ["no-such-program", "/etc/hostname"])
def test_a_program_that_cannot_be_started_is_named(word, tmp_path):
    with pytest.raises(ProgramError, match=f"can be started, got '{word}': .*; install it"):
        run_program([word], tmp_path, tmp_path, {})


def test_it_is_told_how_long_it_has_and_is_stopped_before_its_process_is(shell, tmp_path):
    script = 'echo "$MOCAPBENCH_SECONDS" > told; echo step 1 >&2; exec sleep 604'
    started = time.monotonic()
    kind, message = call_in_child(run_with_deadline, shell, script, timeout=60.0)
    assert time.monotonic() - started < 60.0
    assert kind == "TimeoutError"
    assert "to end within 2.7 s, got no end; it said: step 1" in message
    assert (tmp_path / "told").read_text() == "2.7\n"


def test_it_is_told_when_it_is_stopped_by_the_clock(shell, tmp_path, monkeypatch):
    inherited = time.monotonic() + 100.0
    monkeypatch.setenv("MOCAPBENCH_DEADLINE", repr(inherited))
    shell('echo "$MOCAPBENCH_SECONDS $MOCAPBENCH_DEADLINE" > told')
    seconds, deadline = map(float, (tmp_path / "told").read_text().split())
    assert deadline == pytest.approx(inherited - 5.0, abs=0.5)
    assert seconds == pytest.approx(95.0, abs=0.5)


def test_without_a_limit_it_has_endless_time(shell, tmp_path, monkeypatch):
    # Of other tests a limit may be left in this process, which it cannot undo.
    endless = (resource.RLIM_INFINITY,) * 2
    monkeypatch.setattr(resource, "getrlimit", lambda _: endless)
    monkeypatch.delenv("MOCAPBENCH_DEADLINE", raising=False)
    shell('echo "$MOCAPBENCH_SECONDS" > told')
    assert (tmp_path / "told").read_text() == "inf\n"


@pytest.mark.parametrize("script", ["exec tail /dev/zero", "(tail /dev/zero); true"])
def test_one_that_takes_10_gigabytes_is_stopped_at_the_limit_of_its_process(shell, script):
    said = f"echo learning >&2; {script}"
    kind, message, most = call_in_child(take_memory, shell, said, timeout=120.0)
    assert kind == "MemoryError"
    assert f"{most} of memory, got " in message
    assert "; it said: learning" in message


def test_it_may_reserve_addresses_that_it_does_not_use(shell):
    reserve = "import mmap; mmap.mmap(-1, 2**36, mmap.MAP_PRIVATE, mmap.PROT_READ)"
    script = f'{sys.executable} -S -c "{reserve}"'
    assert call_in_child(reserve_addresses, shell, script, timeout=60.0) == ("", "")


@pytest.mark.parametrize("script", ["while :; do :; done", "(while :; do :; done); exit $?"])
def test_its_work_counts_as_that_of_its_process(shell, script):
    with pytest.raises(ProcessDiedError) as raised:
        call_in_child(work_in_vain, shell, script, timeout=60.0)
    assert find_system().is_end_of_work(raised.value.exit_code)


def read_number(path):
    """Return the number in a file that is about to be written."""
    for _ in range(600):
        if path.exists() and path.read_text().strip():
            return int(path.read_text())
        time.sleep(0.1)
    raise AssertionError(f"{path} was not written")


def is_running(number):
    return psutil.pid_exists(number) and psutil.Process(number).status() != psutil.STATUS_ZOMBIE


def wait_for_end(number):
    for _ in range(100):
        if not is_running(number):
            return True
        time.sleep(0.1)
    return False


def test_what_it_leaves_running_ends_with_it(shell, tmp_path):
    shell("sleep 605 & echo $! > pid")
    assert wait_for_end(read_number(tmp_path / "pid"))


@pytest.mark.forks
def test_it_ends_with_its_process_however_that_ends(tmp_path):
    with subprocess.Popen([sys.executable, "-c", SECOND_LIMIT, str(tmp_path)]) as process:
        number = read_number(tmp_path / "pid")
        os.kill(process.pid, signal.SIGKILL)
    assert wait_for_end(number)


def test_a_helper_that_holds_its_output_open_is_not_waited_for(shell):
    started = time.monotonic()
    shell("sleep 606 & exit 0")
    assert time.monotonic() - started < 60.0
