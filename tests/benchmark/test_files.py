import pytest

from mocapbench.benchmark.files import atomic_write, write_text


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
