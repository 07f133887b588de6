"""Text of any encoding is read as text, and its bytes can be had again."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.datasets.encoding import decode_text, encoding_of

NAMES = "Tête, Fuß, Año, Ż, 膝"


@pytest.mark.parametrize(
    "encoding", ["utf-8", "cp1252", "latin-1", "utf-16", "utf-32", "utf-16-le", "utf-8-sig"]
)
@pytest.mark.parametrize("length", [1, 100_000])
def test_names_of_western_europe_are_read(tmp_path, encoding, length):
    text, path = "x" * length + "\nTête Fuß Año 30°\r\n", tmp_path / "names.txt"
    mark = b"\xff\xfe" if encoding == "utf-16-le" else b""
    path.write_bytes(mark + text.encode(encoding))
    read = path.read_bytes().decode(encoding_of(path))
    assert read.removeprefix("\ufeff") == text
    if encoding in {"utf-8", "cp1252", "latin-1"}:
        assert decode_text(text.encode(encoding)) == text


@given(st.binary())
def test_any_bytes_are_text_that_gives_them_again(tmp_path_factory, data):
    text = decode_text(data)
    path = tmp_path_factory.getbasetemp() / "any.txt"
    path.write_bytes(data)
    if not data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = encoding_of(path)
        assert data.decode(encoding) == text
        assert text.encode(encoding) == data


def test_what_other_alphabets_need_stays_in_utf8():
    assert decode_text(NAMES.encode()) == NAMES


def test_quotes_and_euros_of_windows_are_read():
    assert decode_text("“Tête” €".encode("cp1252")) == "“Tête” €"
    assert decode_text(b"T\xeate \x81") == "Tête \x81"  # undefined in Windows-1252
