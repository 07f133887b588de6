"""CSV files as people have them: times, units, quotes, line ends, gaps, and mistakes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.datasets import CSVFormat, FormatError

CSV = CSVFormat()
CELL = st.one_of(
    st.sampled_from(["", "NaN", "nan", "NA", "null"]),
    st.floats(-1e6, 1e6).map(repr),
    st.floats(-1e6, 1e6).map("{:.3f}".format),
    st.integers(-9999, 9999).map("{:+d}".format),
)


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as a CSV file."""

    def read(text, rate=None):
        (tmp_path / "walk.csv").write_text(text, encoding="utf-8", newline="")
        return CSV.read(tmp_path / "walk.csv", rate)

    return read


@settings(max_examples=40)
@given(st.lists(st.tuples(CELL, CELL), min_size=1, max_size=8), st.sampled_from(["\n", "\r\n"]))
def test_only_the_cells_of_gaps_change(tmp_path_factory, rows, end):
    folder = tmp_path_factory.mktemp("csv")
    given_file, out = folder / "given.csv", folder / "out.csv"
    lines = ["note,time,a [cm],b", *(f'"x, {k}",{k},{a},{b}' for k, (a, b) in enumerate(rows))]
    given_file.write_text(end.join(lines) + end, newline="")
    recording = CSV.read(given_file)
    CSV.write(out, recording.with_values(np.full(recording.values.shape, 0.125)), like=given_file)
    missing = {"", "nan", "na", "null"}
    expected = [
        f'"x, {k}",{k},' + ",".join("0.125" if c.lower() in missing else c for c in row)
        for k, row in enumerate(rows)
    ]
    assert out.read_bytes().decode().split(end) == [lines[0], *expected, ""]


def test_columns_are_times_channels_with_units_and_others(read):
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


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "expected the names of the columns, .*, got an empty file; write such as 'time,"),
        ("1,2\n3,4\n", "line 1: expected the names of the columns, .*, got '1,2'"),
        ("time;hip\n0;1\n", "line 1: expected commas between columns, got 'time;hip'; export"),
        (
            "hip,knee\n1,2\n",
            "expected a column 'time' in seconds, or a rate, got the columns hip, k",
        ),
        ("time,hip\n", "expected one frame and one channel or more, got 0 frames and 1 chan"),
        ("time,side\n0,left\n", "got 1 frames and 0 channels; export"),
        ("time,hip\n0,1\n1,1.2x\n", "line 3: expected a number, got '1.2x'; correct the cell"),
        ("time,hip\n0,1\n1,1_000\n", "line 3: expected a number, got '1_000'"),
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
