"""``mocapbench data``, and what a run does about recordings that are not here."""

import os
import shutil
from functools import partial
from pathlib import Path

import pytest

from mocapbench.benchmark import archive_at
from mocapbench.benchmark.registry import LIBRARIES
from mocapbench.datasets import (
    CMULibrary,
    GaitLibrary,
    format_motion,
    format_skeleton,
)

NOBODY = "http://127.0.0.1:9/"


@pytest.fixture
def database(tmp_path, monkeypatch):
    """A folder with one made recording, an empty cache, and a server that does not answer."""
    motion = GaitLibrary().motion("01_01")
    folder = tmp_path / "database" / "subjects" / "99"
    folder.mkdir(parents=True)
    (folder / "99.asf").write_text(format_skeleton(motion.skeleton))
    (folder / "99_01.amc").write_text(format_motion(motion))
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    LIBRARIES.add("cmu", partial(CMULibrary, base_url=NOBODY, retries=0))
    return tmp_path / "database"


def test_renewing_takes_another_copy_as_right(cli, database):
    motion = database / "subjects" / "99" / "99_01.amc"
    assert cli("data", "verify", "99_01", "--data-dir", database) == 0
    motion.write_text(motion.read_text().rstrip())
    assert cli("data", "verify", "99_01", "--data-dir", database) == 2
    assert cli("data", "fetch", "99_01", "--data-dir", database) == 2
    assert "with: mocapbench data renew 99_01" in cli.printed
    assert cli("data", "renew", "99_01", "--data-dir", database) == 0
    assert cli("data", "verify", "99_01", "--data-dir", database) == 0


def test_status_says_what_is_here_and_what_is_not(cli, database):
    assert cli("data", "status", "99_01", "99_02", "--data-dir", database) == 0
    assert "cmu:99_01 │ available" in cli.printed
    assert "cmu:99_02 │ missing" in cli.printed


def test_several_folders_may_be_named_in_one_text(cli, database, tmp_path):
    (tmp_path / "other").mkdir()
    both = f"{tmp_path / 'other'}{os.pathsep}{database}"
    assert cli("data", "status", "99_01", "--data-dir", both) == 0
    assert "cmu:99_01 │ available" in cli.printed
    assert cli("data", "status", "99_01", "--data-dir", f"{both}{os.pathsep}absent") == 2
    assert "got 'absent'" in cli.printed


def test_jobs_of_a_run_find_the_recordings_of_every_folder(cli, database, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "other").mkdir()
    assert archive_at("other", "database").available("cmu:99_01")


def test_status_without_names_lists_what_the_tasks_use(cli, database):
    assert cli("data", "status") == 0
    assert all(f"cmu:{trial}" in cli.printed for trial in ("02_01", "35_03", "10_04"))
    assert "gait" not in cli.printed


def test_status_ends_in_totals_by_folder_and_the_next_command(cli, database):
    named = ("99_01", "99_02", "--data-dir", database)
    assert cli("data", "status", *named) == 0
    assert f"2 recordings: 1 available, 1 missing; 1 in {database} next:" in cli.printed
    assert f"next: `mocapbench data fetch 99_01 99_02 --data-dir {database}`" in cli.printed
    assert cli("data", "status", "99_01", "--data-dir", database) == 0
    assert f"next: `mocapbench data verify 99_01 --data-dir {database}`" in cli.printed
    assert cli("data", "verify", "99_01", "--data-dir", database) == 0
    assert f"next: `mocapbench run --data-dir {database}`" in cli.printed
    (database / "subjects" / "99" / "99_01.amc").write_text("other")
    assert cli("data", "verify", "99_01", "--data-dir", database) == 2
    assert "1 recording: 1 wrong" in cli.printed
    assert "next: remove what is wrong, then `mocapbench data fetch 99_01" in cli.printed


LAFAN1 = "lafan1:subject1, lafan1:subject2 and 3 more cannot be downloaded: get lafan1.zip from "


def test_a_library_stands_for_what_tasks_use_of_it(cli):
    assert cli("data", "status", "lafan1") == 0
    assert all(f"lafan1:subject{number} " in cli.printed for number in range(1, 6))
    assert "5 recordings: 5 missing" in cli.printed
    assert cli("data", "status", "files") == 2
    assert "no task uses recordings of files; name some, as LIBRARY:KEY" in cli.printed


def test_no_command_is_offered_for_what_cannot_be_downloaded(cli, tmp_path):
    assert cli("data", "status", "lafan1") == 0
    assert f"next: {LAFAN1}" in cli.printed
    assert "mocapbench data fetch" not in cli.printed
    assert cli("data", "fetch", "lafan1") == 2
    assert f"error: {LAFAN1}" in cli.printed
    words = ("--profile", "paper", "--tasks", "lafan1", "--models", "linear", "--out", tmp_path)
    for more in (["--dry-run"], ["--dry-run", "--offline"], ["--no-report"]):
        assert cli("run", *words, *more) == (0 if "--dry-run" in more else 4)
        assert "4 of 4 jobs lack 5 recordings; lafan1:subject5, lafan1:subject1 and" in cli.printed
        assert "mocapbench data fetch" not in cli.printed


def test_what_can_be_downloaded_is_told_from_what_cannot(cli):
    assert cli("data", "status", "files:a.csv", "99_03") == 0
    assert "next: `mocapbench data fetch 99_03` downloads 1 of them" in cli.printed
    assert "; files:a.csv cannot be downloaded: put it where the library looks" in cli.printed


def test_a_folder_that_the_environment_names_is_not_repeated(cli, database, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_DATA", str(database))
    assert cli("data", "status", "99_01") == 0
    assert "next: `mocapbench data verify 99_01`" in cli.printed


@pytest.mark.parametrize(
    "command",
    [
        ("run", "--offline", "--tasks", "toy-synthesis"),
        ("run", "--dry-run"),
        ("report",),
        *(("data", name) for name in ("status", "fetch", "verify")),
    ],
    ids=" ".join,
)
def test_an_empty_folder_is_said_to_be_that_by_every_command(
    cli, write_run, command, tmp_path, monkeypatch
):
    (tmp_path / "empty").mkdir()
    write_run(tmp_path / "run", [("toy-synthesis", "test 1", "trivial", 0)])
    out = ("--out", tmp_path / "run") if command[0] != "data" else ()
    assert cli(*command, *out, "--data-dir", tmp_path / "empty") == 2
    assert "expected recordings (subjects/*/*.asf, subjects/*/*.amc, " in cli.printed
    assert "empty', which is empty" in cli.printed
    monkeypatch.setenv("MOCAPBENCH_DATA", str(tmp_path / "empty"))
    assert cli(*command, *out) == 2
    assert "empty', which is empty" in cli.printed


@pytest.mark.parametrize("n_trials", [1, 2, 30])
def test_many_files_without_a_registered_digest_are_said_in_two_lines(cli, database, n_trials):
    first = database / "subjects" / "99" / "99_01.amc"
    for trial in range(2, n_trials + 1):
        shutil.copy(first, first.with_name(f"99_{trial:02d}.amc"))
    trials = [f"99_{trial:02d}" for trial in range(1, n_trials + 1)]
    assert cli("data", "verify", *trials, "--data-dir", database) == 0
    first, others = cli.printed.split("warning: ")[1:]
    assert "99.asf: no digest is registered" in first
    assert others == f"files without a registered digest, accepted and recorded: {n_trials} more"


def test_verify_finds_a_file_that_changed(cli, database):
    assert cli("data", "verify", "99_01", "--data-dir", database) == 0
    assert "verified" in cli.printed
    file = database / "subjects" / "99" / "99_01.amc"
    file.write_text(file.read_text().replace("1", "2", 1))
    assert cli("data", "verify", "99_01", "--data-dir", database) == 2
    assert "expected SHA-256" in cli.printed


def test_verify_names_the_line_of_a_malformed_file(cli, database):
    file = database / "subjects" / "99" / "99_01.amc"
    file.write_text(file.read_text().replace("lfemur", "lfemuur", 1))
    assert cli("data", "verify", "99_01", "--data-dir", database) == 2
    assert "99_01.amc" in cli.printed
    assert "lfemuur" in cli.printed


def test_fetch_without_a_network_says_what_to_do(cli, database):
    assert cli("data", "fetch", "99_02", "--data-dir", database) == 2
    assert "the server does not answer" in cli.printed
    assert "check the network" in cli.printed


@pytest.mark.parametrize("name", ["foo", "x:1", "35"])
@pytest.mark.parametrize("command", ["status", "fetch", "verify"])
def test_a_name_that_is_no_recording_exits_with_2(cli, database, command, name):
    assert cli("data", command, name) == 2
    assert "expected" in cli.printed


def test_a_run_without_a_network_works_without(cli, records, database, tmp_path):
    chosen = ("--tasks", "missing-frames", "--cases", "35-03 three*,synthetic 1")
    arguments = ("--models", "cubic-spline", "--folds", 1, "--out", tmp_path / "run")
    assert cli("run", *chosen, *arguments) == 0
    assert "working without 4 recordings" in cli.printed
    assert "data missing: 1 of 2 jobs lack 4 recordings" in cli.printed
    assert "`mocapbench data fetch 35_03 35_02 12_01 16_15` gets them" in cli.printed
    statuses = {case: r["status"] for (_, case, _, _), r in records(tmp_path / "run").items()}
    assert statuses == {"35-03 three-walkers": "data-missing", "synthetic 1": "ok"}


def test_a_run_on_a_recording_that_is_not_the_registered_one_stops_first(cli, database, tmp_path):
    wrong = database / "subjects" / "35"
    wrong.mkdir()
    for name, source in (("35.asf", "99.asf"), ("35_03.amc", "99_01.amc")):
        (wrong / name).write_bytes((database / "subjects" / "99" / source).read_bytes())
    arguments = ("--tasks", "missing-frames", "--cases", "35-03*", "--data-dir", database)
    assert cli("run", "--offline", *arguments, "--out", tmp_path / "run") == 2
    assert "expected SHA-256" in cli.printed
    assert not Path(tmp_path / "run").exists()
