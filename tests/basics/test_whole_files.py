import os

import pytest

from mocapbench.basics.whole_files import atomic_write, stage_file, target_of, write_text


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    with pytest.raises(RuntimeError), atomic_write(path) as file:
        file.write(b"new")
        raise RuntimeError
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
    assert path.read_text() == "old"


def test_a_text_is_written_as_utf_8_in_place_of_what_was_there(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    write_text(path, "naïve\r\n")
    assert path.read_bytes() == "naïve\r\n".encode()


def test_others_see_a_staged_file_only_once_it_is_whole(tmp_path):
    path = tmp_path / "file"
    with stage_file(path) as temporary:
        temporary.write_text("half")
        assert not path.exists()
        assert target_of(temporary) == "file"
        temporary.write_text("whole")
    assert path.read_text() == "whole"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("umask, mode", [(0o022, 0o644), (0o077, 0o600), (0o007, 0o660)])
def test_who_may_read_a_file_is_as_the_umask_says(tmp_path, umask, mode):
    before = os.umask(umask)
    try:
        write_text(tmp_path / "file", "text")
    finally:
        os.umask(before)
    assert (tmp_path / "file").stat().st_mode & 0o777 == mode


def test_a_staged_file_that_fails_leaves_nothing_and_names_what_was_meant(tmp_path):
    path = tmp_path / "file"
    with pytest.raises(OSError, match="disk full") as raised, stage_file(path):
        raise OSError(28, "disk full")
    assert raised.value.filename == str(path)
    assert list(tmp_path.iterdir()) == []
