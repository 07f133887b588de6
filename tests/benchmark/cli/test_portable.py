"""The commands by what every system has, on a system that looks as Windows does."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hostile_folder import HostileFolder, write_program
from windows_look import write_look

from mocapbench.benchmark.runs.directory import RunDirectory

RUN = (
    *("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--folds", "1"),
    *("--models", "linear,gp-independent,trivial", "--offline", "--no-report", "--jobs", "2"),
)


@pytest.fixture(scope="module")
def look(tmp_path_factory):
    return write_look(tmp_path_factory.mktemp("look") / "windows")


@pytest.fixture
def command(tmp_path_factory, look):
    """Return a function that runs a command in a folder, as it would run on Windows."""
    temporary, program = tmp_path_factory.mktemp("t"), tmp_path_factory.mktemp("p") / "bin"
    path = write_program(program)

    def command(*arguments, folder=temporary, **variables):
        windows = {"MOCAPBENCH_BACKEND": "portable", "PYTHONPATH": str(look)}
        ended = subprocess.run(
            [sys.executable, path, *map(str, arguments)],
            cwd=folder,
            env={**os.environ, **windows, "TMPDIR": str(temporary), **variables},
            capture_output=True,
            check=False,
        )
        assert b"Traceback" not in ended.stderr, ended.stderr.decode()
        return ended

    return command


def read_scores(folder):
    """Return what a run computed, as text, so that NaN equals NaN."""
    return {
        str(record.address): repr([record.scores, record.parts, record.iterations])
        for record in RunDirectory(folder).records()
    }


@pytest.mark.slow
def test_a_run_has_the_same_scores_bit_by_bit_and_runs_no_file_of_its_folder(command, tmp_path):
    hostile = HostileFolder(tmp_path / "sent", tmp_path / "marks")
    windows = command(*RUN, "--out", tmp_path / "windows", folder=hostile.path)
    assert windows.returncode == 0, windows.stderr.decode()
    assert hostile.run_files == []
    linux = command(*RUN, "--out", tmp_path / "linux", MOCAPBENCH_BACKEND="linux", PYTHONPATH="")
    assert linux.returncode == 0, linux.stderr.decode()
    scores = read_scores(tmp_path / "windows")
    assert len(scores) == 3
    assert scores == read_scores(tmp_path / "linux")
    checked = command("check", tmp_path / "windows", "--reference", tmp_path / "linux")
    assert checked.returncode == 0, checked.stderr.decode()


@pytest.mark.slow
def test_files_are_filled_alike(command, tmp_path):
    times = np.arange(60) / 30
    for name in ("walk.csv", "run.csv"):
        rows = [
            f"{t!r},{'' if 20 <= n < 25 else repr(float(np.sin(3 * t)))},{float(np.cos(t))!r}"
            for n, t in enumerate(times.tolist())
        ]
        (tmp_path / name).write_text("\n".join(["time,a,b", *rows]) + "\n")
    options = ("--model", "linear", "--jobs", "2", "--out")
    files = (tmp_path / "walk.csv", tmp_path / "run.csv")
    windows = command("fill", *files, *options, tmp_path / "windows")
    assert windows.returncode == 0, windows.stderr.decode()
    linux = command(
        "fill", *files, *options, tmp_path / "linux", MOCAPBENCH_BACKEND="linux", PYTHONPATH=""
    )
    assert linux.returncode == 0, linux.stderr.decode()
    for file in files:
        written = (tmp_path / "windows" / file.name).read_bytes()
        assert written == (tmp_path / "linux" / file.name).read_bytes()


@pytest.mark.parametrize("encoding", ["cp1252:strict", "ascii:strict"])
def test_what_a_console_cannot_show_ends_no_command(command, encoding):
    listed = command("list", "models", PYTHONIOENCODING=encoding)
    assert listed.returncode == 0
    assert b"mohgp" in listed.stdout


def test_an_unknown_backend_is_named(command):
    refused = command(*RUN, "--out", "new", MOCAPBENCH_BACKEND="windows")
    assert refused.returncode == 2
    assert b"MOCAPBENCH_BACKEND: expected linux or portable" in refused.stderr


def test_every_module_is_imported_without_what_windows_lacks(look):
    """But those of Linux itself, and programs of other environments."""
    code = """
import importlib, pkgutil, mocapbench
linux = ("system.linux", "system.forked_call", "system.forked_workers", ".entrants")
for module in pkgutil.walk_packages(mocapbench.__path__, "mocapbench."):
    if not any(name in module.name for name in linux):
        importlib.import_module(module.name)
"""
    variables = {"PYTHONPATH": str(look), "MOCAPBENCH_BACKEND": "portable"}
    subprocess.run([sys.executable, "-c", code], env={**os.environ, **variables}, check=True)
