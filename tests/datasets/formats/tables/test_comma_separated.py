"""CSV files as people have them: times, units, quotes, line ends, gaps, and mistakes."""

import codecs

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.datasets import CSVFormat, FormatError, TextColumnsWarning

CSV = CSVFormat()
CELL = st.one_of(
    st.sampled_from(["", "NaN", "nan", "NA", "null"]),
    st.floats(-1e6, 1e6).map(repr),
    st.floats(-1e6, 1e6).map("{:.3f}".format),
    st.integers(-9999, 9999).map("{:+d}".format),
)


DIALECTS = [(",", "."), (";", ","), (";", "."), ("\t", ","), ("\t", ".")]
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "utf-32"]


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as a CSV file."""

    def read(text, rate=None):
        (tmp_path / "walk.csv").write_text(text, encoding="utf-8", newline="")
        return CSV.read(tmp_path / "walk.csv", rate)

    return read


def encoded(text, encoding):
    """Return the bytes of a text, which begin with a mark unless they are UTF-8."""
    mark = codecs.BOM_UTF16_BE if encoding == "utf-16-be" else b""
    return mark + text.encode(encoding)


@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
@settings(max_examples=80)
@given(
    st.lists(st.tuples(CELL, CELL), min_size=1, max_size=8),
    st.sampled_from(["\n", "\r\n"]),
    st.sampled_from(DIALECTS),
    st.sampled_from(ENCODINGS),
)
def test_only_the_cells_of_gaps_change(tmp_path_factory, rows, end, dialect, encoding):
    """Whatever is between columns and within numbers, and however the file is encoded."""
    separator, decimal = dialect
    folder = tmp_path_factory.mktemp("csv")
    given_file, out = folder / "given.csv", folder / "out.csv"

    def lines(rows):
        first = separator.join(["note", "time", "a [cm]", "b"])
        note = f'"x{separator} é'
        yield first
        for k, row in enumerate(rows):
            numbers = [cell.replace(".", decimal) for cell in (f"{k}.0", *row)]
            yield separator.join([f'{note} {k}"', *numbers])

    given_file.write_bytes(encoded(end.join([*lines(rows), ""]), encoding))
    recording = CSV.read(given_file)
    missing = {"", "nan", "na", "null"}
    values = [[float(c) if c.lower() not in missing else np.nan for c in row] for row in rows]
    assert np.array_equal(recording.values, values, equal_nan=True)
    CSV.write(out, recording.with_values(np.full(recording.values.shape, 0.125)), like=given_file)
    filled = [["0.125" if c.lower() in missing else c for c in row] for row in rows]
    assert out.read_bytes() == encoded(end.join([*lines(filled), ""]), encoding)


def test_columns_are_times_channels_with_units_and_others(read):
    with pytest.warns(TextColumnsWarning, match=r"^walk.csv: left out, .* not numbers: side$"):
        walk = read("frame,Time,knee [°],hip [mm],side\n1,0.0,1,2,left\n2,0.5,,3,left\n")
    assert (walk.channels, walk.units) == (("knee", "hip"), ("deg", "mm"))
    assert walk.times.tolist() == [0.0, 0.5]
    assert walk.visible.tolist() == [[True, True], [False, True]]


def test_a_rate_takes_the_place_of_times(read):
    assert read("hip\n1\n2\n", rate=4.0).times.tolist() == [0.0, 0.25]
    assert read("time,hip\n,1\n7,2\n", rate=4.0).times.tolist() == [0.0, 0.25]


@pytest.mark.parametrize(
    ("column", "channel", "unit"),
    [
        ("knee (deg)", "knee", "deg"),
        ("knee.rx ( Degrees )", "knee.rx", "deg"),
        ("hip.x(mm)", "hip.x", "mm"),
        ("hip (m/s)", "hip", "m/s"),
        ("knee (left) [rad]", "knee (left)", "rad"),
        ("knee (left) (rad)", "knee (left)", "rad"),
        ("knee (left)", "knee (left)", ""),
        ("hip (min)", "hip (min)", ""),
        ("force [N]", "force", "N"),
        ("(mm)", "(mm)", ""),
    ],
)
def test_a_unit_stands_in_brackets_or_a_known_one_in_parentheses(read, column, channel, unit):
    walk = read(f"time,{column}\n0,1\n0.5,2\n")
    assert (walk.channels, walk.units) == ((channel,), (unit,))


def test_a_column_that_is_never_visible_is_a_channel(read):
    assert read("time,hip,knee\n0,1,\n1,2,NaN\n").channels == ("hip", "knee")


def test_what_excel_writes_can_be_read(read):
    walk = read('\ufefftime,"left knee, x [mm]"\r\n0,1.5\r\n1,\r\n\r\n\r\n')
    assert (walk.channels, walk.units, len(walk.times)) == (("left knee, x",), ("mm",), 2)


def test_rotations_are_unwrapped_in_and_wrapped_out(read, tmp_path):
    walk = read("time,yaw [deg]\n0,170\n1,\n2,\n3,-160\n")
    assert walk.values[3, 0] == 200.0
    filled = walk.with_values([[170.0], [180.5], [190.25], [200.0]])
    CSV.write(tmp_path / "out.csv", filled, like=tmp_path / "walk.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[1:] == ["0,170", "1,-179.5", "2,-169.75", "3,-160"]


@pytest.mark.parametrize("mark", ["x", "lost", "0-0", "#REF!"])
@pytest.mark.parametrize("n_marked", [1, 5, 8])
def test_a_column_of_numbers_is_never_taken_for_text(read, mark, n_marked):
    """However many of its cells are no numbers, if these are alike."""
    rows = [f"{k},{k},{mark if k < n_marked else k}" for k in range(10)]
    with pytest.raises(FormatError, match=rf"line 2: .* a number, got '{mark}' in column 'knee'; "):
        read("\n".join(["time,hip,knee", *rows]))


WORDS = (
    "",
    "NaN",
    "-nan",
    "+NAN",
    "NA",
    "n/a",
    "#N/A",
    "null",
    "None",
    "-",
    "--",
    "?",
    "1.#QNAN",
    "<NA>",
    ".",
    "#NV",
)


@pytest.mark.parametrize("word", [*WORDS, "-1.#IND", "-nan(ind)", "#DIV/0!", " nan ", "missing"])
def test_words_of_many_programs_mark_missing_values(read, word):
    values = read(f"time,hip,knee\n0,1,{word}\n1,{word},3\n2,3,4\n").values
    assert np.array_equal(values, [[1, np.nan], [np.nan, 3], [3, 4]], equal_nan=True)


def test_labels_with_a_number_among_them_are_text(read):
    with pytest.warns(TextColumnsWarning, match="not numbers: phase"):
        walk = read("time,hip,phase\n0,1,swing\n1,2,stance\n2,3,3\n3,4,swing\n")
    assert walk.channels == ("hip",)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("time;hip\n0;1\n0,5;2\n", [1.0, 2.0]),
        ("time;hip, left\n0;1,5\n0,5;2,5\n", [1.5, 2.5]),
        ("time;hip\n0;1.5\n1;\n", [1.5, np.nan]),
        ('time;hip;note\n0;"1,5";"a;b. c"\n1;"2,5";\n', [1.5, 2.5]),
        ("time,hip;left\n0,1.5\n1,2.5\n", [1.5, 2.5]),
    ],
)
@pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning")
def test_the_first_line_tells_what_is_between_columns(read, text, values):
    assert np.array_equal(read(text).values[:, 0], values, equal_nan=True)


def test_without_a_decimal_mark_semicolons_tell_of_commas(read, tmp_path):
    for separator, number in ((";", "1,5"), ("\t", "1.5")):
        jump = read(f"hip{separator}knee\n1{separator}2\n{separator}3\n", rate=1.0)
        CSV.write(tmp_path / "out.csv", jump.with_values([[1, 2], [1.5, 3]]), tmp_path / "walk.csv")
        assert (tmp_path / "out.csv").read_text().splitlines()[2] == f"{number}{separator}3"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "expected the names of the columns, .*, got an empty file; write such as 'time,"),
        ("1,2\n3,4\n", "line 1: expected the names of the columns, .*, got '1,2'"),
        ("time;a\n0,5;1\n1,5;1.5\n", "line 3: .* such as 1,5 or -1000, got '1.5' in column 'a'"),
        ("time;a\n0.5;1\n1.5;1,5\n", "line 3: .* such as 1.5 or -1000, got '1,5' in column 'a'"),
        ("time;a\n0,5;1\n1,5;1.000,5\n", "line 3: .* 1,5 or -1000, got '1.000,5'"),
        ("time;a\n0;1.000,5\n", "line 2: .* such as 1,5 or -1000, got '1.000,5'"),
        ("time;a\n0;1,000.5\n", "line 2: .* such as 1.5 or -1000, got '1,000.5'"),
        ("time;a\n0;1 000,5\n", "line 2: .* such as 1,5 or -1000, got '1 000,5'"),
        (
            'time,a\n0,"0,5"\n',
            "line 2: .* such as 1.5 or -1000, got '0,5' in column 'a'; write all",
        ),
        ("time,a\n0,00,1,50\n", "line 2: .* 2 cells, got 4 between commas; .* put semicolons"),
        ("# 100 Hz\ntime,hip\n0,1\n", "line 1: .*, got '# 100 Hz'; remove what stands above"),
        ("# a,b\ntime,hip\n0,1\n", "line 1: .*, got '# a,b'; remove what stands above"),
        (
            "Sampling rate:,100\nSubject,Ann\n\nTime,hip.x,hip.y\n0,1,2\n0.1,1,2\n",
            "line 1: .* got 'Sampling rate:,100'; line 4 seems to name the columns, .* C3D or TRC",
        ),
        (
            "1.5,2,3\n2.5,3,4\n",
            "line 1: .* got '1.5,2,3'; export the table with its head, or",
        ),
        ("time,hip\r0,1\n1,2\r", "line 1: .* end with LF or CR LF, got .* CR alone; save it"),
        ("time,hip\n0,1\n1,\0\n", "line 3: expected text in UTF-8, .* got a NUL byte; save"),
        ("t\0,\0h\0\n\0", "expected text in UTF-8, .* got UTF-16 without that mark; save it"),
        (
            "hip,knee\n1,2\n",
            "expected a column 'time' in seconds, or a rate, got the columns hip, k",
        ),
        ("time,hip\n", "expected one frame and one channel or more, got 0 frames and 1 chan"),
        pytest.param(
            "time,side\n0,left\n",
            "got 1 frames and 0 channels; export",
            marks=pytest.mark.filterwarnings("ignore::mocapbench.datasets.TextColumnsWarning"),
        ),
        (
            "time,hip\n0,1\n1,1.2x\n",
            "line 3: expected a number, got '1.2x' in column 'hip'; correct the cell",
        ),
        ("time,hip\n0,1\n1,1_000\n", "line 3: expected a number such as 1.5 or -1000, got '1_000'"),
        ("time,hip\n0,1\n1\n", "line 3: expected 2 cells, got 1 cells; export .* in whole"),
        ("time,hip\n0,1\n1,2,3\n", "line 3: expected 2 cells, got 3 cells"),
        ("time,hip\n0,1\n\n2,2\n", "line 3: expected 2 cells, got 1 cells"),
        ("time,hip\n0,1\n,2\n", "expected a time for every frame, got none for frame 1; correct"),
        ("time,hip\n0,1\n0,2\n", "every time after the one before, got 0 s after 0 s at frame 1;"),
        ("time,hip\n1,1\n0,2\n", "got 0 s after 1 s at frame 1; correct the times, or name a rate"),
        (
            "time,hip\n0,inf\n",
            "finite numbers, .* got inf at frame 0 of hip; leave the entry empty",
        ),
        ("time,hip\n0,1e999\n", "finite numbers, .* got inf at frame 0 of hip"),
        (
            "time,hip\n0,-1e200\n",
            r"numbers, -1e\+100 to 1e\+100, .* got -1e\+200 at frame 0 of hip",
        ),
        ("time,hip,hip\n0,1,2\n", "channels with different names, got 'hip' 2 times; rename"),
    ],
)
def test_what_is_wrong_is_said_plainly(read, text, complaint):
    with pytest.raises(FormatError, match=complaint):
        read(text)
