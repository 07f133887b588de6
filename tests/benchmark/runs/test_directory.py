"""A run directory: what is saved is loaded, and what is damaged or foreign is said to be."""

import hashlib
import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from plans import plan_of

from mocapbench.basics.system.base import LOCK
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

HERE = Address("t", 1, "c", 0, "label")


def test_a_folder_of_other_things_is_refused(tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(UsageError, match="name a new or empty folder"):
        RunDirectory.create(tmp_path)
    with pytest.raises(UsageError, match="is not a mocapbench run"):
        RunDirectory(tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_file_in_place_of_the_folder_is_refused(tmp_path):
    path = tmp_path / "file"
    path.touch()
    with pytest.raises(UsageError, match="expected a folder"):
        RunDirectory.create(path)


@pytest.mark.parametrize("marker", ['{"format": 1}', '{"format": "2"}', "{}", "2", "[", "\xff"])
@pytest.mark.parametrize(
    "take_up", [RunDirectory, RunDirectory.create, RunDirectory.require_usable]
)
def test_a_run_directory_of_another_layout_is_refused(store, marker, take_up):
    (store.path / "mocapbench.json").write_text(marker, encoding="latin-1")
    before = {path: path.stat().st_mtime_ns for path in store.path.rglob("*")}
    with pytest.raises(UsageError, match="of another version of mocapbench"):
        take_up(store.path)
    assert before == {path: path.stat().st_mtime_ns for path in store.path.rglob("*")}


@pytest.mark.parametrize(
    "command",
    [
        ("run", "--offline", "--tasks", "toy-interpolation-1", "--out"),
        ("report", "--out"),
        ("export", "--to", "tables"),
        ("status",),
        ("compare",),
        ("power",),
        ("check", "--controls"),
    ],
    ids=lambda command: command[0],
)
def test_every_command_tells_another_layout_in_one_line_and_exits_with_2(cli, store, command):
    (store.path / "mocapbench.json").write_text('{"format": 1}')
    assert cli(*command, store.path) == 2
    assert cli.printed == (
        f"error: {store.path} is a run directory of another version of mocapbench: expected "
        '{"format": 2} in its mocapbench.json, got {"format": 1}; name a new folder and run '
        "`mocapbench run` again"
    )


HOLD = (
    "import sys\n"
    "from pathlib import Path\n"
    "from mocapbench.benchmark.runs.directory import RunDirectory\n"
    "with RunDirectory(Path(sys.argv[1])).locked():\n"
    "    print('held', flush=True)\n"
    "    sys.stdin.read()\n"
)


def test_others_see_that_a_run_is_writing_and_are_kept_out(store):
    assert not store.is_locked
    with store.locked():
        assert store.is_locked
        other = RunDirectory(store.path)
        with pytest.raises(UsageError, match="another run is writing"), other.locked():
            pass
    assert not store.is_locked


def test_a_lock_is_seen_in_another_process_and_ends_with_it(store):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(store.path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout.readline() == "held\n"
        assert store.is_locked
    finally:
        process.kill()
        process.communicate(timeout=60)
    assert not store.is_locked


def test_to_look_for_a_lock_does_not_need_to_write(store):
    with store.locked():
        pass
    lock = store.path / "mocapbench.lock"
    lock.chmod(0o444)
    before = lock.stat().st_mtime_ns
    assert not store.is_locked
    assert lock.stat().st_mtime_ns == before


def test_a_record_that_is_saved_is_loaded(store, record):
    store.save(record)
    assert store.load(record.key) == record
    assert store.records() == [record]
    assert store.damaged == []


def test_a_damaged_record_is_reported_and_not_trusted(store, record):
    store.save(record)
    path = store.path / "records" / record.key[:2] / f"{record.key}.json"
    path.write_bytes(path.read_bytes()[:-20])
    assert store.load(record.key) is None
    assert str(path) in store.damaged[0]


@pytest.mark.parametrize("entry", ["problem", "missing", "fetch", "scores"])
def test_a_record_that_lacks_an_entry_is_damaged(store, record, entry):
    store.save(record)
    path = store.record_path(record.key)
    document = json.loads(path.read_text())
    del document[entry]
    path.write_text(json.dumps(document))
    assert store.load(record.key) is None
    assert entry in store.damaged[0]


def test_a_record_under_another_name_is_not_trusted(store, record):
    store.save(record)
    other = store.record_path("x" * 64)
    other.parent.mkdir()
    store.record_path(record.key).rename(other)
    assert store.load("x" * 64) is None
    assert "holds the record" in store.damaged[0]


def test_a_record_of_another_row_than_the_plan_says_is_not_trusted(store, record):
    other = replace(record, key="b" * 64, address=HERE._replace(fold=1))
    store.save_plan(plan_of([record, other]))
    store.save(record)
    store.save(replace(other, address=record.address))
    assert store.planned() == [record]
    assert f"expected the record of {other.address}, got {record.address}" in store.damaged[0]


def test_no_folder_holds_more_than_a_small_part_of_many_records(store, record):
    keys = [hashlib.sha256(bytes([n, m])).hexdigest() for n in range(8) for m in range(125)]
    for key in keys:
        store.save(replace(record, key=key))
    assert [found.key for found in store.records()] == sorted(keys)
    assert max(len([*folder.iterdir()]) for folder in (store.path / "records").iterdir()) < 20


def test_records_and_predictions_lie_under_the_first_two_digits_of_their_keys(store, record):
    store.save(record)
    store.save_fit("key", _fit())
    assert store.record_path(record.key) == store.path / "records" / "kk" / f"{'k' * 64}.json"
    assert store.fit_path("key") == store.path / "predictions" / "ke" / "key.npz"
    assert (store.record_keys(), store.fit_keys()) == ({record.key}, {"key"})
    store.record_path(record.key).rename(store.path / "records" / "flat.json")
    assert store.record_keys() == set()


def _fit(**about):
    return Fit({"mean-0": np.arange(6.0).reshape(2, 3)}, 1.5, 0.5, 100.0, 7, True, **about)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_predictions_survive_and_truncated_ones_are_reported(store, data):
    fit = _fit(engine="dense", warnings=("careful",))
    store.save_fit("key", fit)
    back = store.load_fit("key")
    assert store.has_fit("key")
    np.testing.assert_array_equal(back.arrays["mean-0"], fit.arrays["mean-0"])
    assert back.costs == fit.costs
    path = store.fit_path("key")
    path.write_bytes(path.read_bytes()[: data.draw(st.integers(0, path.stat().st_size - 1))])
    store.damaged.clear()
    assert store.load_fit("key") is None
    assert len(store.damaged) == 1
    assert not store.has_fit("key")


def test_predictions_under_another_name_are_not_trusted(store):
    store.save_fit("key", _fit())
    store.fit_path("key").rename(store.fit_path("kept"))
    assert store.load_fit("kept") is None
    assert "another job" in store.damaged[0]
    store.damaged.clear()
    assert not store.has_fit("kept")
    assert "another job" in store.damaged[0]


def test_a_damaged_plan_says_what_to_do(store):
    with pytest.raises(UsageError, match="run `mocapbench run` again"):
        store.load_plan()
    for foreign in ("{}", "5", "[]", '{"keys": [], "provenance": {}}', "{"):
        (store.path / "plan.json").write_text(foreign)
        with pytest.raises(UsageError, match=r"expected a plan; .* run` again"):
            store.load_plan()


def test_damaged_keys_are_reported_and_written_again(store):
    store.keep_keys({"k": (HERE, {"seed": "0"})})
    path = store.path / "keys.json"
    path.write_text(path.read_text()[:-5])
    assert store.load_keys() == {}
    assert "keys.json: expected a list of keys" in store.damaged[0]
    store.keep_keys({"k": (HERE, {"seed": "0"})})
    assert store.load_keys() == {"k": (HERE, {"seed": "0"})}


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.recursive(
        st.none() | st.integers() | st.text(max_size=5),
        lambda x: st.lists(x) | st.dictionaries(st.text(max_size=5), x),
    )
)
def test_foreign_keys_are_reported(store, document):
    (store.path / "keys.json").write_text(json.dumps(document))
    store.damaged.clear()
    assert store.load_keys() == {}
    assert "keys.json: expected a list of keys" in store.damaged[0]


def test_parts_of_keys_are_kept_as_long_as_their_record(store):
    store.save(Record("a" * 64, "f", HERE, 0, "m", {}, Status.OK))
    one, other, third = ((HERE, {"seed": str(n)}) for n in range(3))
    store.keep_keys({"a" * 64: one, "b" * 64: other})
    store.keep_keys({"c" * 64: third})
    assert store.load_keys() == {"a" * 64: one, "c" * 64: third}


CHECK = {"reference": "values", "summary": "nothing is worse", "passed": True, "findings": []}


def test_what_a_check_found_is_kept_until_the_next_plan(store):
    assert store.load_check() is None
    store.save_check(CHECK)
    assert store.load_check() == CHECK
    store.save_plan(plan_of([]))
    assert store.load_check() is None
    assert store.damaged == []


@pytest.mark.parametrize("text", ["", "{", "5", "[]", "[[1, 2]]", json.dumps({"passed": True})])
def test_a_damaged_check_is_reported_and_not_trusted(store, text):
    (store.path / "check.json").write_text(text)
    assert store.load_check() is None
    assert "check.json: expected a check" in store.damaged[0]


DIE_WHILE_WRITING = (
    "import os, sys\n"
    "from pathlib import Path\n"
    "from mocapbench.basics.whole_files import atomic_write\n"
    "with atomic_write(Path(sys.argv[1])) as file:\n"
    "    file.write(b'half')\n"
    "    file.flush()\n"
    "    os.kill(os.getpid(), 9)\n"
)


@pytest.mark.parametrize(
    "name", ["records/ab/abc.json", "predictions/ab/abc.npz", "plan.json", "report.html"]
)
def test_what_a_killed_process_left_is_deleted(store, name):
    path = store.path / name
    path.parent.mkdir(exist_ok=True, parents=True)
    path.write_text("whole")
    before = {p for p in store.path.rglob("*") if p.is_file()}
    done = subprocess.run([sys.executable, "-c", DIE_WHILE_WRITING, str(path)], check=False)
    assert done.returncode == -9
    left = {p for p in store.path.rglob("*") if p.is_file()} - before
    assert len({p for p in left if p.suffix != LOCK}) == 1
    store.sweep()
    assert {p for p in store.path.rglob("*") if p.is_file()} == before
    assert path.read_text() == "whole"


OTHERS = (
    ".hidden",
    ".mocapbench",
    "plan.json.tmp",
    "mocapbench-tmp-12345678",
    "mine/.mocapbench-tmp-12345678",
    "records/ab/.notes",
)


@pytest.mark.parametrize("name", OTHERS)
def test_other_files_are_left_alone(store, name):
    (store.path / name).parent.mkdir(exist_ok=True, parents=True)
    (store.path / name).write_text("mine")
    store.sweep()
    assert (store.path / name).read_text() == "mine"


def test_a_link_is_not_followed(store, tmp_path):
    (tmp_path / "mine").write_text("mine")
    (store.path / ".mocapbench-tmp-12345678").symlink_to(tmp_path / "mine")
    store.sweep()
    assert (tmp_path / "mine").read_text() == "mine"


def test_a_folder_that_a_killed_command_began_is_made_a_run(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", DIE_WHILE_WRITING, str(tmp_path / "mocapbench.json")], check=False
    )
    assert done.returncode == -9
    RunDirectory.create(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mocapbench.json"]
