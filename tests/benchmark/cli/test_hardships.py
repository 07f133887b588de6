"""Runs under hardship: killed, cut off from the terminal, with garbled files, by another clock."""

import os
import pty
import signal
import subprocess
import sys
import time

import psutil
import pytest
from sessions import list_session

TOY = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
FAST = (*TOY, "--models", "trivial,cubic-spline")
FOLDS = 60  # so many that the run is not over before it is disturbed
LONG = (*FAST, "--folds", FOLDS, "--jobs", 1)
SCRIPT = "from mocapbench.benchmark.cli.main import main; main()"


def _scores(records):
    return {address: record["scores"] for address, record in records.items()}


def _start(arguments, **options):
    command = [sys.executable, "-c", SCRIPT, *map(str, arguments)]
    return subprocess.Popen(command, start_new_session=True, text=True, **options)


def _wait_for_records(process, out, count=3):
    while len([*out.glob("records/*/*.json")]) < count:
        assert process.poll() is None
        time.sleep(0.01)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Return the folder of a run that nothing disturbed."""
    out = tmp_path_factory.mktemp("hardships") / "whole"
    assert _start((*LONG, "--out", out, "--jobs", 2), stdout=subprocess.DEVNULL).wait() == 0
    return out


def _resumes(cli, records, out, whole):
    """Check that the same command ends what is in ``out`` as if nothing had happened."""
    kept = len(records(out))
    assert 3 <= kept < 2 * FOLDS
    assert cli(*LONG, "--out", out) == 0
    assert f"{kept} of {2 * FOLDS} jobs are in" in cli.printed
    assert _scores(records(out)) == _scores(records(whole))
    files = [sorted(path.name for path in d.glob("predictions/*/*")) for d in (out, whole)]
    assert files[0] == files[1]


ENDINGS = {signal.SIGKILL: -signal.SIGKILL, signal.SIGINT: 130, signal.SIGTERM: 143} | {
    signal.SIGHUP: 129
}


@pytest.mark.slow
@pytest.mark.parametrize("how", ENDINGS, ids=lambda how: how.name)
def test_an_interrupted_run_resumes_to_the_same_scores(cli, records, tmp_path, whole, how):
    out = tmp_path / "broken"
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process = _start((*LONG, "--out", out), **pipes)
    _wait_for_records(process, out)
    os.killpg(process.pid, how)
    stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == ENDINGS[how]
    assert "mocapbench" not in stderr  # where a traceback of ours would name its files
    assert ("the same command resumes" in stdout) is (ENDINGS[how] > 0)
    psutil.wait_procs(list_session(process), timeout=60)
    assert not list_session(process)
    _resumes(cli, records, out, whole)


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT], ids=lambda how: how.name)
def test_nothing_outlives_the_run_when_it_alone_is_ended(tmp_path, how):
    process = _start((*LONG, "--out", tmp_path / "run"), stdout=subprocess.DEVNULL)
    _wait_for_records(process, tmp_path / "run")
    others = [each for each in list_session(process) if each.pid != process.pid]
    assert others
    process.send_signal(how)
    process.wait(timeout=60)
    psutil.wait_procs(list_session(process), timeout=60)
    assert not list_session(process)


@pytest.mark.slow
def test_a_closed_terminal_ends_the_run_which_resumes(cli, records, tmp_path, whole):
    terminal, inside = pty.openpty()
    process = _start((*LONG, "--out", tmp_path / "run"), stdout=inside, stderr=inside, stdin=inside)
    os.close(inside)
    _wait_for_records(process, tmp_path / "run")
    os.close(terminal)
    os.killpg(process.pid, signal.SIGHUP)  # as the system does where it is the session's terminal
    assert process.wait(timeout=60) == 129
    _resumes(cli, records, tmp_path / "run", whole)


@pytest.mark.slow
def test_nohup_keeps_a_run_alive(tmp_path):
    command = ["nohup", sys.executable, "-c", SCRIPT, *map(str, LONG), "--out", tmp_path / "run"]
    process = subprocess.Popen(
        command, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _wait_for_records(process, tmp_path / "run")
    os.killpg(process.pid, signal.SIGHUP)
    assert process.wait(timeout=300) == 0


GARBLED = {
    "empty": b"",
    "zeros": bytes(1000),
    "another format": b'{"format": 99}',
    "a list": b"[]",
    "no text": bytes(range(128, 256)),
}


@pytest.mark.parametrize("content", GARBLED.values(), ids=GARBLED)
@pytest.mark.parametrize("kind", ["records", "predictions"])
def test_a_garbled_file_is_named_and_computed_again(cli, records, tmp_path, kind, content):
    out = tmp_path / "run"
    assert cli(*FAST, "--out", out) == 0
    whole = _scores(records(out))
    for path in out.glob(f"{kind}/*/*"):
        path.write_bytes(content)
    for path in [*out.glob("records/*/*")][:1]:
        path.unlink(missing_ok=True)  # whose predictions are looked at
    assert cli(*FAST, "--out", out) == 0
    assert _scores(records(out)) == whole


def test_a_folder_that_cannot_be_written_exits_with_2(cli):
    assert cli(*FAST, "--out", "/proc/mocapbench") == 2
    assert "expected a folder that can be written to, got /proc/mocapbench (" in cli.printed
    assert "Errno" not in cli.printed


def test_a_clock_that_jumps_changes_nothing(cli, records, tmp_path, monkeypatch):
    assert cli(*FAST, "--out", tmp_path / "plain") == 0
    real, calls = time.time, []

    def jumping():
        calls.append(1)
        return real() + (-1) ** len(calls) * 10**6

    monkeypatch.setattr(time, "time", jumping)
    assert cli(*FAST, "--out", tmp_path / "jumping", "--timeout", 60) == 0
    assert _scores(records(tmp_path / "jumping")) == _scores(records(tmp_path / "plain"))


@pytest.mark.slow
def test_scores_are_the_same_bits_whatever_does_not_matter(cli, records, tmp_path):
    plain = (*TOY, "--models", "trivial,knn,mohgp-3")
    variants = {
        "one job": (*plain, "--jobs", 1),
        "four jobs": (*plain, "--jobs", 4),
        "threads": (*plain, "--threads", 2),
        "order": (*TOY, "--models", "mohgp-3,knn", "--models", "trivial"),
        "others": (*plain, "--models", "gp-independent,moa-3"),
        "alone": (*TOY, "--models", "mohgp-3"),
    }
    assert cli(*plain, "--out", tmp_path / "plain") == 0
    expected = _scores(records(tmp_path / "plain"))
    for name, arguments in variants.items():
        assert cli(*arguments, "--out", tmp_path / name) == 0
        found = _scores(records(tmp_path / name))
        shared = found.keys() & expected.keys()
        assert shared
        assert {address: found[address] for address in shared} == {
            address: expected[address] for address in shared
        }
    for seed in ("0", "1"):
        out, environment = tmp_path / seed, {**os.environ, "PYTHONHASHSEED": seed}
        process = _start((*plain, "--out", out), env=environment, stdout=subprocess.DEVNULL)
        assert process.wait(timeout=300) == 0
        assert _scores(records(out)) == expected
