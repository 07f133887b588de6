"""TRC files: heads, empty cells, line ends, and what is wrong with some."""

import numpy as np
import pytest
from format_files import markers, with_gap, write_trc

from mocapbench.datasets import FormatError, TRCFormat

TRC = TRCFormat()


@pytest.fixture
def given(tmp_path):
    write_trc(tmp_path / "given.trc", with_gap(markers(40)))
    return tmp_path / "given.trc"


def test_markers_units_times_and_gaps(given):
    recording = TRC.read(given)
    assert recording.channels == markers(40).channels
    assert set(recording.units) == {"mm"}
    assert np.array_equal(recording.visible, with_gap(markers(40)).visible)
    assert np.allclose(recording.times, np.arange(40) / 120, atol=1e-6)
    assert np.allclose(recording.values, with_gap(markers(40)).values, atol=1e-5, equal_nan=True)


def test_only_the_cells_of_gaps_change(given, tmp_path):
    recording = TRC.read(given)
    TRC.write(tmp_path / "out.trc", recording.with_values(np.full((40, 15), 0.5)), like=given)
    before, after = ((p.read_bytes().split(b"\r\n")) for p in (given, tmp_path / "out.trc"))
    assert len(before) == len(after)
    changed = [k for k, (one, two) in enumerate(zip(before, after, strict=True)) if one != two]
    assert changed == [*range(26, 36)]
    for k in changed:
        cells = before[k].split(b"\t")
        assert after[k].split(b"\t") == [*cells[:2], *[b"0.5"] * 3, *cells[5:]]


def test_rows_may_lack_the_empty_cells_at_their_end(given, tmp_path):
    lines = given.read_text().splitlines()
    lines[10] = "\t".join(lines[10].split("\t")[:8])
    given.write_text("\n".join(lines))
    recording = TRC.read(given)
    assert recording.visible[4].tolist() == [True] * 6 + [False] * 9
    TRC.write(tmp_path / "out.trc", recording.with_values(np.full((40, 15), 0.5)), like=given)
    assert TRC.read(tmp_path / "out.trc").values[4, 6:].tolist() == [0.5] * 9


def test_a_marker_at_the_origin_is_visible(given):
    lines = given.read_text().splitlines()
    lines[10] = "\t".join([*lines[10].split("\t")[:14], "0.0", "0.0", "0.0"])
    given.write_text("\n".join(lines))
    assert TRC.read(given).visible[4, 12:].all()


WRONG = {
    "an empty file": (lambda t: "", "5 lines of head, .*, got an empty file; export the markers"),
    "another file": (lambda t: "time,hip\n0,1\n" * 9, "5 lines of head, .*, got 'time,hip'"),
    "only a head": (lambda t: "".join(t.splitlines(keepends=True)[:6]), "40 frames, .* got 0 rows"),
    "cut short": (lambda t: t[: len(t) // 2], "expected (40 frames, .* got|17 cells)"),
    "markers": (
        lambda t: t.replace("\t40\t5\t", "\t40\t6\t"),
        "6 markers, as line 3 says, got 5 n",
    ),
    "no count": (
        lambda t: t.replace("NumFrames", "Frames"),
        "expected NumFrames frames, as line 3",
    ),
    "words": (
        lambda t: t.replace("\r\n9\t", "\r\n9\tsoon\t"),
        "line 15: expected 17 cells, got 18",
    ),
    "a word": (
        lambda t: t.replace("\t0.066667\t", "\tsoon\t"),
        "line 15: expected a number, got 's",
    ),
    "no time": (
        lambda t: t.replace("\t0.066667\t", "\t\t"),
        "a time for every frame, got none for",
    ),
    "twice": (
        lambda t: t.replace("\t0.066667\t", "\t0.058333\t"),
        "got 0.058333 s after 0.058333 s",
    ),
}


@pytest.mark.parametrize("change", WRONG)
def test_what_is_wrong_is_said_plainly(given, change):
    alter, complaint = WRONG[change]
    given.write_text(alter(given.read_bytes().decode()), newline="")
    with pytest.raises(FormatError, match=complaint):
        TRC.read(given)
