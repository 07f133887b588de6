"""BVH files: any channels, NaN, rotations that wrap, and what is wrong with some."""

import re

import numpy as np
import pytest
from format_files import walk, with_gap, write_bvh

from mocapbench.datasets import BVHFormat, FormatError

BVH = BVHFormat()
SMALL = """\
HIERARCHY
ROOT Hips
{
\tOFFSET 0.0 0.0 0.0
\tCHANNELS 6 Zrotation Xrotation Yrotation Xposition Yposition Zposition
\tJOINT Left Knee
\t{
\t\tOFFSET 0.0 -1.0 0.0
\t\tCHANNELS 1 Xrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0.0 -1.0 0.0
\t\t}
\t}
}
MOTION
Frames:\t4
Frame Time: 0.0333333
 170.0 0 0  1.50 2 3\t5.0
-175 0 0  nan 2 3\t6.00
NaN  0 0  2.50 2 3\t7.
-150.0 0 0  3.5 2 3\t+8e0
"""


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a text as a BVH file."""

    def read(text):
        (tmp_path / "walk.bvh").write_text(text, newline="")
        return BVH.read(tmp_path / "walk.bvh")

    return read


def test_channels_keep_their_order_and_rotations_their_unit(read):
    small = read(SMALL)
    of_hips = ["Hips.rz", "Hips.rx", "Hips.ry", "Hips.tx", "Hips.ty", "Hips.tz"]
    assert small.channels == (*of_hips, "Left Knee.rx")
    assert small.units == ("deg",) * 3 + ("",) * 3 + ("deg",)
    assert np.allclose(small.times, np.arange(4) * 0.0333333)
    assert np.array_equal(small.values[:, 0], [170.0, 185.0, np.nan, 210.0], equal_nan=True)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_only_the_words_of_gaps_change(read, tmp_path, end):
    text = SMALL.replace("\n", end)
    small = read(text)
    values = np.where(small.visible, small.values, [[197.5, 0, 0, 2.25, 0, 0, 0]])
    BVH.write(tmp_path / "out.bvh", small.with_values(values), like=tmp_path / "walk.bvh")
    expected = text.replace("nan", "2.25").replace("NaN", "-162.5")
    assert (tmp_path / "out.bvh").read_bytes().decode() == expected


def test_a_gap_that_the_user_names_is_replaced(tmp_path):
    write_bvh(tmp_path / "walk.bvh", walk())
    recording = BVH.read(tmp_path / "walk.bvh")
    replaced = ~with_gap(walk()).visible
    filled = recording.with_values(np.where(replaced, 0.5, recording.values))
    BVH.write(tmp_path / "out.bvh", filled, tmp_path / "walk.bvh", replaced)
    before, after = ((tmp_path / name).read_text().split() for name in ("walk.bvh", "out.bvh"))
    assert sum(one != two for one, two in zip(before, after, strict=True)) == 30


HABITS = {
    "upper case": lambda text: text.replace("position", "Position").replace("End Site", "END SITE"),
    "lower case": lambda text: text.replace("Frame Time", "frame time").replace("Xrot", "xrot"),
    "named ends": lambda text: text.replace("End Site", "End Site Toe"),
    "braces behind names": lambda text: re.sub(r"\n\t*\{", " {", text),
    "no blank before a number": lambda text: text.replace(":\t4", ":4").replace("e: 0", "e:0"),
    "blanks before colons": lambda text: text.replace("s:", "s :").replace("e:", "e :"),
    "blank lines": lambda text: text.replace("\n", "\n\n"),
    "decimal commas": lambda text: re.sub(r"(?<=\d)\.", ",", text),
    "milliseconds": lambda text: text.replace("0.0333333", "33.3333"),
}


@pytest.mark.filterwarnings("ignore:.* is taken for milliseconds")
@pytest.mark.parametrize("habit", HABITS)
def test_what_programs_and_hands_write_is_read_alike(read, tmp_path, habit):
    plain, text = read(SMALL), HABITS[habit](SMALL)
    assert text != SMALL
    odd = read(text)
    assert (odd.channels, odd.units) == (plain.channels, plain.units)
    np.testing.assert_array_equal(odd.values, plain.values)
    np.testing.assert_allclose(odd.times, plain.times)
    filled = odd.with_values(np.where(odd.visible, odd.values, -1.5))
    BVH.write(tmp_path / "out.bvh", filled, like=tmp_path / "walk.bvh")
    mark = "-1,5" if "commas" in habit else "-1.5"
    expected = re.sub("nan", mark, text, flags=re.IGNORECASE)
    assert (tmp_path / "out.bvh").read_text() == expected


def test_a_frame_of_milliseconds_is_said(read):
    with pytest.warns(UserWarning, match="'Frame Time:' is 33.3333, so it is taken for millisec"):
        read(HABITS["milliseconds"](SMALL))


WRONG = {
    "": "line 1: expected 'MOTION' below the hierarchy, got the end of the file; export",
    "MOTION\n": "line 1: expected 'Frames:' with a positive number, got the end of the file",
    "time,hip\n0,1\n": "line 1: expected a hierarchy of joints with OFFSET .*, got 'time,",
    SMALL.replace("CHANNELS 6", "CHANNELS 5"): "line 5: expected a hierarchy .*, got 'CHANNELS 5 Z",
    SMALL.replace(
        "CHANNELS 1 X", "CHANNELS 1 W"
    ): "line 9: expected .*, got 'CHANNELS 1 Wrotation'",
    SMALL.replace("}\nMOTION", "MOTION"): "line 15: expected a hierarchy .*, got 'MOTION'",
    SMALL.replace("}\nMOTION", "}\n}\nMOTION"): "line 16: expected a hierarchy .*, got '}'",
    SMALL.replace("Left Knee", "Hips"): "channels with different names, got 'Hips.rx' 2 times",
    SMALL.replace(":\t4", ":\t6"): "expected 6 frames, as 'Frames:' says, got 4 rows; the file may",
    SMALL.replace(
        ":\t4", ":\t0"
    ): "line 17: expected 'Frames:' with a positive number, got 'Frames:",
    SMALL.replace(
        "0.0333333", "nan"
    ): "line 18: expected 'Frame Time:' with a positive number, got",
    SMALL.replace("7.\n", "\n"): "line 21: expected 7 cells, got 6 cells; export",
    SMALL.replace("6.00", "6.00 7"): "line 20: expected 7 cells, got 8 cells; export",
    SMALL.replace(
        "6.00", "soon"
    ): "line 20: expected a number, got 'soon' in column 7; correct the cell",
    SMALL.replace("6.00", "1e999"): "finite numbers, .*, got inf at frame 1 of Left Knee.rx",
    SMALL[:300]: "expected 4 frames, as 'Frames:' says|expected|7 cells",
}


@pytest.mark.parametrize("text", WRONG)
def test_what_is_wrong_is_said_plainly(read, text):
    with pytest.raises(FormatError, match=WRONG[text]):
        read(text)


@pytest.mark.parametrize("stated", [1, 3, 5])
def test_rows_that_the_count_does_not_know_are_read_and_one_may_be_missing(read, tmp_path, stated):
    text = SMALL.replace(":\t4", f":\t{stated}")
    with pytest.warns(UserWarning, match=f"expected {stated} frames, as .* got 4 rows, which are"):
        odd = read(text)
    assert np.array_equal(odd.values, read(SMALL).values, equal_nan=True)
    (tmp_path / "walk.bvh").write_text(text)
    with pytest.warns(UserWarning, match="which are read"):
        BVH.write(tmp_path / "out.bvh", odd, like=tmp_path / "walk.bvh")
    assert (tmp_path / "out.bvh").read_text() == text
