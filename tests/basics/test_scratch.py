"""A folder of temporary files goes with its maker, or when the next one is made."""

import os
import signal
import subprocess
import sys
import tempfile

import pytest

from mocapbench.basics.scratch import scratch_folder
from mocapbench.basics.system.base import LOCK

HOLD_ONE = (
    "import os, time\n"
    "from mocapbench.basics.scratch import scratch_folder\n"
    "with scratch_folder() as folder:\n"
    "    (folder / 'file').write_text('mine')\n"
    "    os.write(1, f'{folder}\\n'.encode())\n"
    "    time.sleep(600)\n"
)


@pytest.fixture(autouse=True)
def own_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)


@pytest.fixture
def other():
    with subprocess.Popen(
        [sys.executable, "-c", HOLD_ONE], stdout=subprocess.PIPE, text=True
    ) as process:
        process.stdout.readline()
        yield process
        process.kill()


def list_folders(parent):
    return {path for path in parent.iterdir() if path.suffix != LOCK}


def test_it_goes_with_the_context(tmp_path):
    with scratch_folder() as folder:
        (folder / "file").write_text("mine")
        assert folder.parent == tmp_path
    assert not list(tmp_path.iterdir())


def test_it_goes_with_an_error(tmp_path):
    with pytest.raises(ValueError, match="mine"), scratch_folder():
        raise ValueError("mine")
    assert not list(tmp_path.iterdir())


def test_that_of_a_living_process_is_left_alone(tmp_path, other):
    (theirs,) = list_folders(tmp_path)
    with scratch_folder() as ours:
        assert list_folders(tmp_path) == {ours, theirs}
    assert (theirs / "file").read_text() == "mine"


def test_that_of_a_killed_process_goes_when_the_next_is_made(tmp_path, other):
    (theirs,) = list_folders(tmp_path)
    other.send_signal(signal.SIGKILL)
    other.wait()
    assert theirs.exists()
    with scratch_folder() as ours:
        assert list_folders(tmp_path) == {ours}


@pytest.mark.forks
def test_it_lives_while_a_child_of_its_killed_maker_does(tmp_path):
    fork = HOLD_ONE.replace("    os.write", "    os.fork()\n    os.write", 1)
    with subprocess.Popen(
        [sys.executable, "-c", fork], stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as maker:
        theirs = {maker.stdout.readline().strip() for _ in range(2)}
        maker.kill()
        maker.wait()
        with scratch_folder() as ours:
            assert {str(path) for path in tmp_path.iterdir()} == {str(ours), *theirs}
        os.killpg(maker.pid, signal.SIGKILL)


@pytest.mark.parametrize("name", ["mocapbench-results", "scratch", ".mocapbench"])
def test_other_folders_are_left_alone(tmp_path, name):
    (tmp_path / name).mkdir()
    with scratch_folder():
        pass
    assert (tmp_path / name).exists()


def test_a_link_is_not_followed(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "file").write_text("mine")
    (tmp_path / ".mocapbench-tmp-abcdefgh").symlink_to(tmp_path / "mine")
    with scratch_folder():
        pass
    assert (tmp_path / "mine" / "file").read_text() == "mine"
