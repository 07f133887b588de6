"""What a killed process leaves goes at the next start, and what counted already is finished.

A process kills itself at each of the moments at which it asks something of the system.
"""

import fcntl
import os
import signal
import stat
import subprocess
import sys
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import pytest

from mocapbench.basics import temporaries
from mocapbench.basics.system import portable
from mocapbench.basics.temporaries import (
    PREFIX,
    final_place,
    sweep,
    temporary_file,
    temporary_folder,
)
from mocapbench.basics.whole_files import write_files, write_text, write_together

WATCHED = {"open", "os.mkdir", "os.rename", "os.remove", "os.rmdir", "fcntl.flock", "shutil.rmtree"}


def die_at(moment, work, *arguments):
    """Return whether a process that does some work dies before it asks for the n-th thing."""
    child = os.fork()
    if child:
        _, status = os.waitpid(child, 0)
        assert status in (0, signal.SIGKILL)
        return status == signal.SIGKILL
    asked = count()

    def watch(event, _):
        if event in WATCHED and next(asked) == moment:
            os.kill(os.getpid(), signal.SIGKILL)

    try:
        sys.addaudithook(watch)
        work(*arguments)
    finally:
        os._exit(0)


def texts(folder):
    return {path.name: path.read_text() for path in folder.iterdir()}


def update(folder):
    with write_together(folder, "a", obsolete=["gone"]) as drafts:
        write_text(drafts / "a", "new")
        (drafts / "b").write_text("new")


OLD, NEW = {"a": "old", "gone": "old"}, {"a": "new", "b": "new"}


def lay_out(folder):
    folder.mkdir()
    for name, text in OLD.items():
        (folder / name).write_text(text)
    return folder


@pytest.fixture(params=["linux", "portable"])
def backend(request, monkeypatch):
    """Each on a system of its own: on Linux, the portable one leaves what has no lock."""
    monkeypatch.setenv("MOCAPBENCH_BACKEND", request.param)
    if request.param == "portable":
        monkeypatch.setattr(portable, "sys", SimpleNamespace(platform="darwin"))


@pytest.mark.usefixtures("backend")
def test_killed_at_any_moment_all_files_change_or_none_does(tmp_path):
    ends, moment = [], count()
    while die_at(number := next(moment), update, lay_out(tmp_path / f"{number}")):
        folder = tmp_path / f"{number}"
        sweep(folder)
        ends.append(texts(folder))
    assert texts(tmp_path / f"{number}") == NEW
    changed = ends.index(NEW)
    assert changed > 10
    assert ends[:changed] == [OLD] * changed
    assert ends[changed:] == [NEW] * (len(ends) - changed)
    assert len(ends) - changed > 4


@pytest.mark.usefixtures("backend")
def test_killed_at_any_moment_a_sweep_loses_nothing(tmp_path):
    """Neither does the second one, which finds what the first left."""
    moment = count()
    while True:
        folder = lay_out(tmp_path / f"{(number := next(moment))}")
        _decide_only(folder)
        died = die_at(number, sweep, folder)
        sweep(folder)
        assert texts(folder) == NEW
        if not died:
            break
    assert number > 4


@pytest.mark.usefixtures("backend")
def test_killed_at_any_moment_one_file_is_old_or_new(tmp_path):
    moment = count()
    while die_at(number := next(moment), write_text, lay_out(tmp_path / f"{number}") / "a", "new"):
        sweep(tmp_path / f"{number}")
        assert texts(tmp_path / f"{number}") in (OLD, OLD | {"a": "new"})
    assert number > 2


def test_writing_again_needs_no_sweep(tmp_path):
    folder = lay_out(tmp_path / "folder")
    assert die_at(8, update, folder)
    assert [path for path in folder.iterdir() if path.name.startswith(PREFIX)]
    update(folder)
    assert texts(folder) == NEW


def test_what_a_living_process_writes_is_left_alone(tmp_path):
    with temporary_folder(tmp_path) as folder, temporary_file(tmp_path) as file:
        (folder / "mine").write_text("mine")
        file.write_text("mine")
        with subprocess.Popen([sys.executable, "-c", SWEEP, str(tmp_path)]) as other:
            assert other.wait() == 0
        sweep(tmp_path)
        assert (folder / "mine").read_text() == file.read_text() == "mine"
    assert not [*tmp_path.iterdir()]


SWEEP = """
import sys
from pathlib import Path
from mocapbench.basics.temporaries import sweep
sweep(Path(sys.argv[1]))
"""


@pytest.mark.forks
@pytest.mark.parametrize("make", [temporary_folder, temporary_file])
def test_what_was_swept_before_it_was_locked_is_made_again(tmp_path, monkeypatch, make):
    """Another process takes it for left behind in the moment between."""
    lock, made = fcntl.flock, []

    def lock_late(descriptor, operation):
        monkeypatch.setattr("fcntl.flock", lock)
        made.extend(tmp_path.iterdir())
        sweep(tmp_path)
        lock(descriptor, operation)

    monkeypatch.setattr("fcntl.flock", lock_late)
    with make(tmp_path) as path:
        assert len(made) == 1
        sweep(tmp_path)
        assert [*tmp_path.iterdir()] == [path]
        assert path != made[0]


@pytest.mark.forks
def test_a_process_forked_from_the_maker_keeps_it(tmp_path):
    read, write = os.pipe()
    maker = os.fork()
    if not maker:
        with temporary_folder(tmp_path):
            if os.fork():
                os._exit(0)
            os.read(read, 1)
            os._exit(0)
    os.waitpid(maker, 0)
    sweep(tmp_path)
    assert len([*tmp_path.iterdir()]) == 1
    os.write(write, b".")
    while [*tmp_path.iterdir()]:
        sweep(tmp_path)


@pytest.mark.forks  # the portable backend leaves an empty lock
def test_git_takes_nothing_of_what_was_left(tmp_path):
    folder = lay_out(tmp_path / "folder")
    _decide_only(folder)
    for words in (["init", "-q"], ["add", "."]):
        subprocess.run(["git", *words], cwd=folder, check=True)
    done = subprocess.run(["git", "ls-files"], cwd=folder, check=True, capture_output=True)
    assert done.stdout.decode().split() == [*OLD]


@pytest.mark.parametrize("inner", ["decided", "obsolete"])
@pytest.mark.usefixtures("backend")
def test_a_link_that_somebody_sent_is_not_followed(tmp_path, inner):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "file").write_text("mine")
    folder = lay_out(tmp_path / "folder")
    left = folder / f"{PREFIX}sent"
    (left / "decided").mkdir(parents=True)
    if inner == "decided":
        (left / "decided").rmdir()
    (left / inner).symlink_to(tmp_path / "mine")
    (folder / "file").write_text("mine, too")
    sweep(folder)
    assert texts(tmp_path / "mine") == {"file": "mine"}
    assert texts(folder) == OLD | {"file": "mine, too"}


def test_where_files_have_no_locks_all_is_written_and_nothing_is_swept(tmp_path, monkeypatch):
    folder = lay_out(tmp_path / "folder")
    left = folder / f"{PREFIX}left"
    left.write_text("of a process that may live")
    monkeypatch.setattr("fcntl.flock", _refuse)
    update(folder)
    sweep(folder)
    assert left.exists()
    left.unlink()
    assert texts(folder) == NEW


def test_what_is_of_another_user_stays(tmp_path, monkeypatch):
    left = tmp_path / f"{PREFIX}left"
    left.write_text("theirs")
    monkeypatch.setattr("os.geteuid", lambda: left.stat().st_uid + 1)
    sweep(tmp_path)
    assert left.exists()


def test_a_file_of_a_temporary_folder_is_known_by_its_place():
    assert final_place(Path("a", f"{PREFIX}b", "drafts", "c")) == Path("a", "c")
    assert final_place(Path("a", f"{PREFIX}b", "drafts", f"{PREFIX}c", "d")) == Path("a", "d")
    assert final_place(Path("a", "drafts", "c")) == Path("a", "drafts", "c")


def test_only_their_maker_may_look_into_temporary_folders(tmp_path):
    with temporary_folder(tmp_path) as folder:
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700


def test_two_files_of_one_name_are_written_one_by_one(tmp_path):
    write_files({tmp_path / "a": b"one"})
    write_files({tmp_path / "a": b"other"})
    assert texts(tmp_path) == {"a": "other"}


def _decide_only(folder):
    """Leave what a process leaves that is killed once its files count."""
    child = os.fork()
    if not child:
        temporaries.finish = lambda _: os._exit(0)
        update(folder)
    os.waitpid(child, 0)
    assert [*folder.glob(f"{PREFIX}*/decided/a")]


def _refuse(*_):
    raise OSError(38, "Function not implemented")
