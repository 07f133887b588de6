"""TRC files: heads, empty cells, line ends, and what is wrong with some."""

import re
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from format_files import markers, with_gap, write_trc
from hypothesis import given as drawn_from
from hypothesis import strategies as st

from mocapbench.datasets import FormatError, TRCFormat
from mocapbench.datasets.formats.markers.channels import marker_channels

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
    "an empty file": (lambda t: "", "begins with 'Frame#' .*, got an empty file; export the mark"),
    "another file": (lambda t: "time,hip\n0,1\n" * 9, "begins with 'Frame#' .*, got 'time,hip'"),
    "only a head": (
        lambda t: "".join(t.splitlines(keepends=True)[:6]),
        "one frame .* got 0 frames and 15 ch",
    ),
    "cut short": (
        lambda t: t[: t.index("\r\n9\t") + 40],
        "line 15: expected 17 cells, as above, got [2-9] cells; copy or export",
    ),
    "words": (
        lambda t: t.replace("\r\n9\t", "\r\n9\tsoon\t"),
        "line 15: expected 17 cells, got 18",
    ),
    "names in between": (
        lambda t: t.replace("root\t\t\t", "root\thip\t\t"),
        "line 4: expected a name for every three columns, got 6 names for 15 columns; write",
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


def with_cells(text, change):
    """Return a text whose rows of numbers are changed, each a list of cells."""
    head, rows = text.split("\r\n\r\n")
    changed = ["\t".join(change(row.split("\t"))) for row in rows.splitlines()]
    return "\r\n".join([head, "", *changed, ""])


def without_rows(text, first, stop):
    """Return a text without some lines, counted from 0."""
    lines = text.splitlines(keepends=True)
    return "".join(lines[:first] + lines[stop:])


NAMES = ("root", "lowerback", "upperback", "thorax", "lowerneck")
HEAD = "Frame#\tTime\t" + "\t\t\t".join(NAMES) + "\t\t"
UNNAMED = "expected NumMarkers to be 5, as line 3 says, got columns of 6, 5 with names"
ODD = {  # each with what it warns of
    "more frames stated": (lambda t: t.replace("\t40\t", "\t900\t"), "NumFrames to be 900, .* 40"),
    "fewer frames stated": (
        lambda t: t.replace("\t40\t", "\t3\t"),
        "NumFrames to be 3, .* 40 rows",
    ),
    "more markers stated": (
        lambda t: t.replace("\t5\tmm", "\t10\tmm"),
        "NumMarkers to be 10, .* 5",
    ),
    "columns without names": (lambda t: with_cells(t, lambda row: [*row, *"789"]), UNNAMED),
    "a gap between names": (
        lambda t: with_cells(
            t.replace("upperback", "\t\t\tupperback"), lambda row: [*row[:8], *"789", *row[8:]]
        ),
        UNNAMED,
    ),
    "missing rows": (
        lambda t: without_rows(t, 40, 43).replace("\t40\t", "\t37\t"),
        "3 rows are missing, behind line 40, by the steps of 'Frame#'; --insert-missing",
    ),
    "decimal counts": (lambda t: t.replace("\t40\t5\t", "\t40.00\t5.0\t"), ""),
    "counts in words": (lambda t: t.replace("\t40\t5\t", "\tmany\tfew\t"), ""),
    "no counts": (lambda t: t.replace("NumFrames", "Frames"), ""),
    "no facts": (lambda t: without_rows(t, 0, 3), ""),
    "no axes": (lambda t: without_rows(t, 4, 6), ""),
    "blanks for tabs in the head": (
        lambda t: t.replace("Type\t4\t", "Type  4 ").replace("\t40\t5\tmm\t", "  40 \t\t5  mm "),
        "",
    ),
    "blanks around names": (lambda t: t.replace("Time\troot", " Time\t root "), ""),
    "names side by side": (lambda t: t.replace(HEAD, HEAD.replace("\t\t\t", "\t")), ""),
    "names far apart": (lambda t: t.replace(HEAD, HEAD.replace("\t\t\t", "\t" * 6)), ""),
    "a blank between frame and time": (lambda t: t.replace("Frame#\tTime", "Frame# Time"), ""),
    "blanks between names": (
        lambda t: t.replace(HEAD, re.sub("\t+", "  ", HEAD)),
        "",
    ),
    "quotes": (lambda t: t.replace("root", '"root"'), ""),
    "decimal commas": (lambda t: t.replace("markers.", "markers").replace(".", ","), ""),
    "commas for tabs": (lambda t: t.replace("\t", ","), ""),
    "semicolons for tabs": (lambda t: t.replace("\t", ";").replace(".", ","), ""),
    "blank lines": (lambda t: t.replace("\r\n", "\r\n\r\n"), ""),
    "tabs at the ends of lines": (lambda t: t.replace("\r\n", "\t \t\r\n"), ""),
    "line ends of Unix": (lambda t: t.replace("\r\n", "\n"), ""),
    "line ends of old Macintoshes": (lambda t: t.replace("\r\n", "\r"), ""),
    "line ends of both": (lambda t: t.replace("\r\n", "\n", 20), ""),
    "line ends twice": (lambda t: t.replace("\r\n", "\r\r\n"), ""),
    "no line end": (lambda t: t.rstrip(), ""),
    "blank cells at the end": (lambda t: t + "\t\t\r\n \r\n", ""),
}


def read_odd(path, change, tmp_path):
    """Return what is read of a changed file, and its text."""
    alter, complaint = ODD[change]
    text = alter(path.read_bytes().decode())
    (tmp_path / "odd.trc").write_text(text, newline="")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        recording = TRC.read(tmp_path / "odd.trc")
    said = [str(warning.message) for warning in caught]
    assert len(said) == bool(complaint)
    assert all(re.search(complaint, one) for one in said)
    return recording, text


@pytest.mark.parametrize("change", ODD)
def test_the_rows_that_there_are_count_whatever_else_is_said(given, tmp_path, change):
    odd, _ = read_odd(given, change, tmp_path)
    plain = TRC.read(given)
    kept = np.isin(np.round(plain.times, 5), np.round(odd.times, 5))
    assert len(odd.times) == kept.sum() >= 37
    assert np.array_equal(odd.select(plain.channels).values, plain.values[kept], equal_nan=True)
    extra = {*odd.channels} - {*plain.channels}
    assert extra <= {"unlabelled.x", "unlabelled.y", "unlabelled.z"}
    assert all(odd.select([name]).values[0] in (7, 8, 9) for name in extra)


@pytest.mark.filterwarnings("ignore:odd.trc. expected")
@pytest.mark.parametrize("change", ODD)
def test_no_other_character_is_written(given, tmp_path, change):
    odd, text = read_odd(given, change, tmp_path)
    like, out = tmp_path / "odd.trc", tmp_path / "out.trc"
    TRC.write(out, odd, like)
    assert out.read_bytes().decode() == text
    TRC.write(out, odd.with_values(np.where(odd.visible, odd.values, 12345.5)), like)
    written = out.read_bytes().decode().replace("12345,5", "12345.5")
    assert written.count("12345.5") == (~odd.visible).sum() == 30
    assert written.replace("12345.5", "") == text.replace("12345,5", "")
    again = TRC.read(out)
    assert np.array_equal(again.values[odd.visible], odd.values[odd.visible])
    assert (again.values[~odd.visible] == 12345.5).all()


@pytest.mark.parametrize("head", [True, False])
def test_blanks_may_separate_rows_that_lack_nothing(tmp_path, head):
    write_trc(tmp_path / "given.trc", markers(40))
    plain, text = TRC.read(tmp_path / "given.trc"), (tmp_path / "given.trc").read_text()
    above, rows = text.split("\n\n")
    spaced = [above.replace("\t\t\t", "  ").replace("\t", " ") if head else above]
    spaced.append(rows.replace("\t", "   ").replace("NaN", "nan"))
    (tmp_path / "spaced.trc").write_text("\n\n".join(spaced))
    read = TRC.read(tmp_path / "spaced.trc")
    assert read.channels == plain.channels
    assert np.array_equal(read.values, plain.values)
    replaced = np.zeros(read.values.shape, dtype=bool)
    replaced[5, 3] = True
    values = np.where(replaced, 0.5, read.values)
    TRC.write(tmp_path / "out.trc", read.with_values(values), tmp_path / "spaced.trc", replaced)
    one, two = ((tmp_path / f"{name}.trc").read_text() for name in ("spaced", "out"))
    assert [a for a, b in zip(one.split(), two.split(), strict=True) if a != b] == [
        f"{plain.values[5, 3]:.5f}"
    ]


@pytest.mark.parametrize("between", ["\t\t", " ", "  \t "])
def test_facts_are_known_whatever_stands_between_them(given, between):
    lines = given.read_bytes().decode().splitlines()
    lines[2] = between.join(lines[2].replace("\t40\t", "\t41\t").split("\t"))
    given.write_text("\n".join(lines))
    with pytest.warns(
        UserWarning, match="expected NumFrames to be 41, as line 3 says, got 40 rows"
    ):
        assert set(TRC.read(given).units) == {"mm"}


def test_rows_that_are_missing_are_added(given, tmp_path):
    plain, text = TRC.read(given), given.read_bytes().decode()
    given.write_text(without_rows(text, 15, 17), newline="")
    kind = TRC.with_missing_rows()
    with warnings.catch_warnings(action="ignore"):  # the head states more rows
        short = kind.read(given)
        kind.write(tmp_path / "out.trc", plain.with_values(np.nan_to_num(plain.values)), given)
    assert (~short.visible).all(axis=1).nonzero()[0].tolist() == [9, 10]
    written = (tmp_path / "out.trc").read_bytes().decode().splitlines()[15:17]
    assert [line.split("\t")[0] for line in written] == ["10", "11"]
    times = [float(line.split("\t")[1]) for line in written]
    np.testing.assert_allclose(times, [9 / 120, 10 / 120], atol=2e-6)
    np.testing.assert_allclose(TRC.read(tmp_path / "out.trc").values[9:11], plain.values[9:11])


@pytest.mark.parametrize(("digits", "what"), [(2, "rounded to 0.01 s"), (1, "rounded to 0.1 s")])
def test_times_that_repeat_as_they_are_rounded_are_those_of_the_rate(given, digits, what):
    text = given.read_bytes().decode()
    given.write_text(
        with_cells(text, lambda row: [row[0], f"{float(row[1]):.{digits}f}", *row[2:]]), newline=""
    )
    with pytest.warns(UserWarning, match=f"times are {what}: those of 120 frames per second"):
        walk = TRC.read(given)
    np.testing.assert_allclose(walk.times, np.arange(40) / 120)


def test_times_that_are_missing_are_those_of_the_rate(given):
    text = given.read_bytes().decode()
    given.write_text(with_cells(text, lambda row: [row[0], "", *row[2:]]), newline="")
    with pytest.warns(UserWarning, match="times are missing: those of 120 frames per second"):
        np.testing.assert_allclose(TRC.read(given).times, np.arange(40) / 120)


def test_a_rate_that_disagrees_with_the_times_is_said(given):
    given.write_text(given.read_text().replace("120.00\t120.00", "100.00\t120.00"), newline="")
    with pytest.warns(UserWarning, match="expected 100 frames per second, .* got 120 by its times"):
        TRC.read(given)


LABELS = st.lists(st.sampled_from(["", "LKNE", "R.Knee Lat", "*12", "Fuß", "a-b", "7"]), max_size=6)
NUMBERS = st.one_of(st.none(), st.floats(-1e4, 1e4).map(lambda value: round(value, 3)))


@st.composite
def wild_texts(draw):
    """Draw a text with its names and rows: counts, blanks, separators and ends of any kind."""
    names = [*draw(LABELS), "LAST"]
    row = st.lists(NUMBERS, min_size=3 * len(names), max_size=3 * len(names))
    rows = draw(st.lists(row, min_size=1, max_size=5))
    separator, end = draw(st.sampled_from("\t;,")), draw(st.sampled_from(["\n", "\r\n", "\r"]))
    counts = [draw(st.sampled_from(["", "3", "7.0", " 12 ", "many"])) for _ in range(2)]
    facts = [["DataRate", "NumFrames", "NumMarkers", "Units"], ["100", *counts, "mm"]]
    above = [name for label in names for name in (label, "", "")]
    cells = [
        [str(k), f"{k / 100}", *("" if value is None else f"{value}" for value in one)]
        for k, one in enumerate(rows)
    ]
    head = [["PathFileType", "4"], *facts, ["Frame#", "Time", *above]]
    axes = draw(st.sampled_from([[], [["", "", "X1", "Y1", "Z1"]], [["", "", "X1"], [""]]]))
    lines = [separator.join(line) for line in (*head, *axes, *cells)]
    blanks = draw(st.sampled_from([end, end * 2]))
    return blanks.join(lines) + draw(st.sampled_from(["", end, end * 3])), names, rows


@pytest.mark.filterwarnings("ignore:wild.trc. expected")
@drawn_from(wild_texts())
def test_any_head_leaves_the_rows_to_be_read_and_written(drawn):
    text, names, rows = drawn
    with TemporaryDirectory() as folder:
        like, out = Path(folder, "wild.trc"), Path(folder, "out.trc")
        like.write_text(text, newline="", encoding="utf-8")
        recording = TRC.read(like)
        assert recording.channels == marker_channels(names)
        expected = np.array(rows, dtype=float)
        assert np.array_equal(recording.values, expected, equal_nan=True)
        TRC.write(out, recording, like)
        assert out.read_bytes() == like.read_bytes()
        TRC.write(out, recording.with_values(np.nan_to_num(expected, nan=0.125)), like)
        again = TRC.read(out).values
        assert np.array_equal(again, np.where(np.isnan(expected), 0.125, expected))
