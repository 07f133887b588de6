"""What a killed run left is deleted, and nothing else."""

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.basics.whole_files import atomic_write, target_of
from mocapbench.benchmark.runs.store import Store

DIE_WHILE_WRITING = (
    "import os, sys\n"
    "from pathlib import Path\n"
    "from mocapbench.basics.whole_files import atomic_write\n"
    "with atomic_write(Path(sys.argv[1])) as file:\n"
    "    file.write(b'half')\n"
    "    file.flush()\n"
    "    os.kill(os.getpid(), 9)\n"
)


@given(st.text("ab.-_é", min_size=1, max_size=30).filter(lambda name: name.strip(".")))
def test_a_temporary_file_tells_what_it_was_meant_for(tmp_path_factory, name):
    folder = tmp_path_factory.mktemp("folder")
    with atomic_write(folder / name) as file:
        (path,) = folder.iterdir()
        file.write(b"whole")
    assert target_of(path) == name
    assert [found.name for found in folder.iterdir()] == [name]
    assert not target_of(folder / name)


@pytest.mark.parametrize(
    "name", ["records/ab/abc.json", "predictions/ab/abc.npz", "plan.json", "keys.json"]
)
def test_what_a_killed_process_left_is_deleted(tmp_path, name):
    store = Store.create(tmp_path)
    path = tmp_path / name
    path.parent.mkdir(exist_ok=True)
    path.write_text("whole")
    before = {p for p in tmp_path.rglob("*") if p.is_file()}
    done = subprocess.run([sys.executable, "-c", DIE_WHILE_WRITING, str(path)], check=False)
    assert done.returncode == -9
    assert len({p for p in tmp_path.rglob("*") if p.is_file()} - before) == 1
    store.sweep()
    assert {p for p in tmp_path.rglob("*") if p.is_file()} == before
    assert path.read_text() == "whole"


OTHERS = (
    ".hidden",
    ".notes.tmp",
    "plan.json.abcdefgh.tmp",
    ".plan.json.abcdefgh",
    ".plan.json.ABCDEFGH.tmp",
    ".plan.json.abcdefghi.tmp",
    ".report.html.abcdefgh.tmp",  # `mocapbench report` may write it just now
    "mine/.plan.json.abcdefgh.tmp",
    "records/ab/.notes",
)


@pytest.mark.parametrize("name", OTHERS)
def test_other_files_are_left_alone(tmp_path, name):
    store = Store.create(tmp_path)
    (tmp_path / name).parent.mkdir(exist_ok=True, parents=True)
    (tmp_path / name).write_text("mine")
    store.sweep()
    assert (tmp_path / name).read_text() == "mine"


def test_a_link_is_deleted_but_not_what_it_leads_to(tmp_path):
    store = Store.create(tmp_path / "run")
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "run" / ".plan.json.abcdefgh.tmp").symlink_to(tmp_path / "mine")
    store.sweep()
    assert (tmp_path / "mine").read_text() == "mine"
