import errno
import os
from pathlib import Path

import pytest

from mocapbench.basics.whole_files import atomic_write
from mocapbench.benchmark.cli.ending.failures import explain, show_warning
from mocapbench.benchmark.errors import ExitCode
from mocapbench.datasets import TruncatedFrameWarning


def test_a_warning_of_ours_is_one_line_and_others_name_their_place(capsys):
    show_warning("walk.amc was cut", TruncatedFrameWarning, "module.py", 7)
    assert capsys.readouterr().err == "warning: walk.amc was cut\n"
    show_warning("overflow", RuntimeWarning, "module.py", 7)
    assert "module.py:7: RuntimeWarning: overflow" in capsys.readouterr().err


def test_an_error_of_the_system_names_the_file_that_people_know(capsys, tmp_path):
    path = tmp_path / "scores.csv"
    with pytest.raises(OSError, match="No space") as full, atomic_write(path):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))  # as write() does, without a name
    assert explain(full.value) is ExitCode.USAGE
    said = capsys.readouterr().err.replace("\n", "")
    assert said == f"error: cannot read or write: {path}: No space left on device"
    assert explain(PermissionError(errno.EACCES, "Permission denied", "scores.csv"))
    assert "write: scores.csv: Permission denied" in capsys.readouterr().err
    assert explain(OSError("told by a library"))
    assert "write: told by a library" in capsys.readouterr().err
    assert explain(ConnectionResetError())
    assert "write: ConnectionResetError" in capsys.readouterr().err


def test_a_file_where_none_can_be_written_is_refused_before_anything(cli, tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path).name != "locked")
    locked = tmp_path / "locked"
    locked.mkdir()
    wanted = ("--markdown", locked / "summary.md")
    assert cli("check", tmp_path, "--reference", tmp_path, *wanted) == 2
    assert "expected a file in a folder that can be written to" in cli.printed
