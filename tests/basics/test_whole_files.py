import os

import pytest

from mocapbench.basics.temporaries import sweep
from mocapbench.basics.whole_files import (
    LONGEST_NAME,
    atomic_write,
    stage_file,
    write_files,
    write_text,
    write_together,
)


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


def test_a_folder_that_is_not_there_is_named_by_the_file_that_was_meant(tmp_path):
    path = tmp_path / "no" / "file"
    with pytest.raises(FileNotFoundError) as raised:
        write_text(path, "text")
    assert raised.value.filename == str(path)


def test_an_error_of_another_file_names_that_file(tmp_path):
    with pytest.raises(FileNotFoundError) as raised, stage_file(tmp_path / "file"):
        (tmp_path / "no").read_text()
    assert raised.value.filename == str(tmp_path / "no")


def test_a_file_may_have_the_longest_name(tmp_path):
    name = "é" * (LONGEST_NAME // 2)
    write_text(tmp_path / name, "text")
    with write_together(tmp_path, name) as drafts:
        write_text(drafts / name, "texts")
    assert (tmp_path / name).read_text() == "texts"


def test_files_take_their_places_together(tmp_path):
    (tmp_path / "a").write_text("old")
    (tmp_path / "gone").write_text("old")
    with write_together(tmp_path, "a", obsolete=["gone", "never there"]) as drafts:
        write_text(drafts / "a", "new")
        (drafts / "b").write_text("new")
        assert (tmp_path / "a").read_text() == "old"
        assert (tmp_path / "gone").exists()
        assert not (tmp_path / "b").exists()
    assert _texts(tmp_path) == {"a": "new", "b": "new"}


def test_none_takes_its_place_if_one_cannot_be_written(tmp_path):
    (tmp_path / "a").write_text("old")
    with (
        pytest.raises(OSError, match="disk full") as raised,
        write_together(tmp_path, "a", obsolete=["a"]) as drafts,
    ):
        write_text(drafts / "a", "new")
        with atomic_write(drafts / "b"):
            raise OSError(28, "disk full")
    assert raised.value.filename == str(tmp_path / "b")
    assert _texts(tmp_path) == {"a": "old"}


def test_what_one_process_writes_no_other_writes_meanwhile(tmp_path):
    with write_together(tmp_path, "a") as drafts, write_together(tmp_path, "b") as others:
        write_text(others / "b", "mine, too")
        with pytest.raises(BlockingIOError, match="another process") as raised:
            write_files({tmp_path / "a": b"theirs"})
        assert raised.value.filename == str(tmp_path / "a")
        sweep(tmp_path)
        write_text(drafts / "a", "mine")
    assert _texts(tmp_path) == {"a": "mine", "b": "mine, too"}


def test_of_files_in_several_folders_none_is_written_if_one_cannot_be(tmp_path):
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
    contents = {tmp_path / "one" / "a": b"a", tmp_path / "other" / "b": b"b"}
    with pytest.raises(FileNotFoundError):
        write_files({**contents, tmp_path / "no" / "c": b"c"})
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]
    write_files(contents)
    assert {path: path.read_bytes() for path in contents} == contents


def _texts(folder):
    return {path.name: path.read_text() for path in folder.iterdir()}
