"""Reading text: complete, with bounded lines, and errors with their lines."""

import pytest

from mocapbench.datasets import AcclaimError
from mocapbench.datasets.acclaim.text import MAX_LINE, Line, finite_floats, name_list, read_text

LIMIT = 2**20


def test_text_is_returned_unchanged(tmp_path):
    path = tmp_path / "a.asf"
    path.write_bytes("one\r\ntwö\n\nthree".encode())
    assert read_text(path, LIMIT) == "one\r\ntwö\n\nthree"


@pytest.mark.parametrize("content", [b"", b" \n\r\n"])
def test_an_empty_file_is_refused(tmp_path, content):
    path = tmp_path / "a.asf"
    path.write_bytes(content)
    with pytest.raises(AcclaimError, match="empty file"):
        read_text(path, LIMIT)


def test_a_missing_file_and_a_folder_are_refused_by_name(tmp_path):
    for path in (tmp_path / "nowhere.asf", tmp_path):
        with pytest.raises(AcclaimError, match="readable file") as caught:
            read_text(path, LIMIT)
        assert (caught.value.file, caught.value.line) == (str(path), None)


def test_bytes_that_are_not_utf8_are_windows_1252(tmp_path):
    path = tmp_path / "a.asf"
    path.write_bytes(b"one\ntwo\nth\xearee\n")
    assert read_text(path, LIMIT) == "one\ntwo\nthêree\n"


def test_a_byte_order_mark_is_left_out(tmp_path):
    path = tmp_path / "a.asf"
    path.write_text("thêree\n", encoding="utf-8-sig")
    assert read_text(path, LIMIT) == "thêree\n"


def test_a_nul_byte_is_refused_with_its_line(tmp_path):
    path = tmp_path / "a.asf"
    path.write_bytes(b"one\ntwo\nth\0ree\n")
    with pytest.raises(AcclaimError, match="expected text in UTF-8 or Windows-1252") as caught:
        read_text(path, LIMIT)
    assert caught.value.line == 3


def test_the_longest_line_is_read_and_one_byte_more_is_not(tmp_path):
    path = tmp_path / "a.asf"
    path.write_bytes(b"one\n" + b"x" * (MAX_LINE - 1) + b"\n")
    assert len(read_text(path, LIMIT)) == MAX_LINE + 4
    path.write_bytes(b"one\n" + b"x" * MAX_LINE + b"\n")
    with pytest.raises(AcclaimError, match="at most") as caught:
        read_text(path, LIMIT)
    assert caught.value.line == 2


def test_the_largest_file_is_read_and_one_byte_more_is_not(tmp_path):
    path = tmp_path / "a.asf"
    path.write_bytes(b"x\n" * 1024)
    assert len(read_text(path, 2048)) == 2048
    with pytest.raises(AcclaimError, match=r"at most .* MiB") as caught:
        read_text(path, 2047)
    assert (caught.value.file, caught.value.line) == (str(path), None)


def test_an_endless_line_is_refused_without_reading_it():
    with pytest.raises(AcclaimError, match="at most"):
        read_text("/dev/zero", LIMIT)


def test_numbers_are_read_in_plain_notation():
    assert finite_floats(["1", "-2.5", "+.5", "7.62852e-016"]) == [1.0, -2.5, 0.5, 7.62852e-16]


@pytest.mark.parametrize("word", ["nan", "inf", "-Infinity", "1e999", "1_0", "１", "x", "0x1"])
def test_what_is_not_a_plain_finite_number_is_refused(word):
    with pytest.raises(ValueError, match=r"finite|convert"):
        finite_floats(["1", word])


@pytest.mark.parametrize("word", ["1e200", "-1e200"])
def test_the_limit_of_numbers_is_named(word):
    with pytest.raises(ValueError, match=r"finite numbers, -1e\+100 to 1e\+100, got"):
        finite_floats([word])
    with pytest.raises(AcclaimError, match=r"with 1 finite numbers, -1e\+100 to 1e\+100, got"):
        Line("a.amc", 7, f"shin {word}").floats(1, 2)


def test_an_error_shows_the_beginning_of_a_long_line():
    error = Line("a.amc", 7, "x" * 1000).error("a number")
    assert str(error).startswith("a.amc, line 7: expected a number, got 'xxx")
    assert len(str(error)) < 120


def test_a_list_of_names_is_whole_unless_it_is_long():
    assert name_list(["hip", "arm"]) == "hip, arm"
    many = name_list(map(str, range(100_000)))
    assert many.startswith("0, 1, 2, ")
    assert many.endswith("…")
    assert len(many) < 500
