"""Names of channels in the encodings of other people: read as text, and written byte for byte."""

import numpy as np
import pytest
from format_files import sample

from mocapbench.benchmark.formats import format_for
from mocapbench.datasets import CSVFormat, Format, FormatError, Recording

ASCII = b"lowerback"
ENCODINGS = {"latin-1": "Tête_Fuß°", "cp1252": "“Tête”_1€", "mac-roman": "Tête_Fuß°"}
ENCODINGS |= {"utf-8": "Tête_Fus", "cp932": "膝膝膝膝_"}


def renamed(path, name):
    """Replace the bytes of a name in a file, and in the skeleton beside it."""
    assert len(name) == len(ASCII)
    for file in {path, path.with_suffix(".asf")}:
        if file.exists():
            file.write_bytes(file.read_bytes().replace(ASCII, name))


def fill(path, out):
    recording = format_for(path).read(path)
    hidden = ~recording.visible
    hidden[20:30, :3] = True  # where a format cannot state a gap
    filled = recording.with_values(np.where(hidden, 12.25, recording.values))
    format_for(path).write(out, filled, like=path, replaced=hidden)
    return recording


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", ["acclaim", "bvh", "c3d", "csv", "trc"])
def test_a_renamed_file_is_filled_as_the_file_is_and_keeps_its_bytes(tmp_path, name, encoding):
    written = ENCODINGS[encoding].encode(encoding)
    path = sample(name, tmp_path)
    plain = fill(path, tmp_path / f"plain{path.suffix}")
    renamed(path, written)
    odd = fill(path, tmp_path / f"odd{path.suffix}")
    assert "".join(odd.channels).encode("utf-8")
    if encoding in {"latin-1", "cp1252", "utf-8"}:
        assert odd.channels == tuple(
            channel.replace(ASCII.decode(), ENCODINGS[encoding]) for channel in plain.channels
        )
        assert odd.channels != plain.channels
    before, after = ((tmp_path / f"{one}{path.suffix}").read_bytes() for one in ("plain", "odd"))
    assert after == before.replace(ASCII, written)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-32"])
@pytest.mark.parametrize("name", ["bvh", "csv", "trc"])
def test_a_byte_order_mark_belongs_to_no_name_and_stays(tmp_path, name, encoding):
    path, out = sample(name, tmp_path), tmp_path / "plain"
    plain = fill(path, out.with_suffix(path.suffix))
    path.write_bytes(path.read_bytes().decode().encode(encoding))
    marked = fill(path, tmp_path / f"marked{path.suffix}")
    assert marked.channels == plain.channels
    expected = out.with_suffix(path.suffix).read_bytes().decode().encode(encoding)
    assert (tmp_path / f"marked{path.suffix}").read_bytes() == expected


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-32-le", "utf-32-be", "cp500"])
@pytest.mark.parametrize("name", ["bvh", "csv", "trc"])
def test_an_encoding_that_nothing_names_is_refused_in_few_words(tmp_path, name, encoding):
    path = sample(name, tmp_path)
    path.write_bytes(path.read_bytes().decode().replace("\n", "\x85").encode(encoding))
    called = "EBCDIC" if encoding == "cp500" else f"{encoding[:6].upper()} without that mark"
    with pytest.raises(FormatError, match=f"expected text in UTF-8.* got {called}") as caught:
        format_for(path).read(path)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-32", "utf-32-le", "cp037"])
@pytest.mark.parametrize("suffix", [".amc", ".asf"])
def test_acclaim_files_are_text_of_one_byte_a_character(tmp_path, suffix, encoding):
    path = sample("acclaim", tmp_path)
    file = path.with_suffix(suffix)
    file.write_bytes(file.read_text().replace("\n", "\x85").encode(encoding))
    called = "EBCDIC" if encoding == "cp037" else encoding[:6].upper()
    with pytest.raises(FormatError, match=f"expected text in UTF-8 or .* got {called}; export"):
        format_for(path).read(path)


@pytest.mark.parametrize("name", ["bvh", "csv", "trc"])
def test_lines_may_end_as_on_an_old_macintosh(tmp_path, name):
    path = sample(name, tmp_path)
    plain = fill(path, tmp_path / f"plain{path.suffix}")
    path.write_bytes(path.read_bytes().replace(b"\r\n", b"\n").replace(b"\n", b"\r"))
    old = fill(path, tmp_path / f"old{path.suffix}")
    assert np.array_equal(old.values, plain.values, equal_nan=True)
    before, after = ((tmp_path / f"{one}{path.suffix}").read_bytes() for one in ("plain", "old"))
    assert after == before.replace(b"\r\n", b"\n").replace(b"\n", b"\r")


def test_a_file_that_is_not_what_its_mark_says_is_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes("\ufefftime,a\ud800\n0,1\n".encode("utf-16-le", "surrogatepass"))
    with pytest.raises(FormatError, match="expected text in UTF-16-LE, as its byte order mark"):
        CSVFormat().read(path)


def test_a_degree_sign_of_windows_is_a_unit(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes("time,Fuß [°]\n0,170\n1,-170\n".encode("cp1252"))
    read = CSVFormat().read(path)
    assert (read.channels, read.units) == (("Fuß",), ("deg",))
    assert read.values.ravel().tolist() == [170.0, 190.0]


def test_markers_whose_names_become_equal_are_told_apart(tmp_path):
    path = sample("c3d", tmp_path)
    given = path.read_bytes().replace(b"lowerback", b"T\xeate_Fus ")
    path.write_bytes(given.replace(b"upperback", "Tête_Fus".encode()))
    assert format_for(path).read(path).channels[3:9:3] == ("Tête_Fus.x", "Tête_Fus-2.x")


class Careless(Format):
    """A format of somebody else that hands on bytes as Python escapes them."""

    suffixes = (".careless",)

    def load(self, path, rate):
        name = path.read_bytes().decode("utf-8", "surrogateescape")
        return Recording(path.name, [0.0, 1.0], [[0.0], [1.0]], [name], ["mm"])

    def save(self, path, values, new, like):
        raise NotImplementedError


def test_a_name_that_no_file_could_hold_is_refused_as_it_is_read(tmp_path):
    path = tmp_path / "a.careless"
    path.write_bytes(b"T\xeate")
    with pytest.raises(FormatError, match=r"whole characters, got 'T\\udceate'; rename"):
        Careless().read(path)
