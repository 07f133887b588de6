"""Acclaim motions as users' files: the skeleton beside them, radians, gaps that are named."""

import shutil

import numpy as np
import pytest
from format_files import KEY, sample, walk

from mocapbench.datasets import AcclaimFormat, FormatError, GaitLibrary, unwrap_angles

AMC = AcclaimFormat()


@pytest.fixture
def given(tmp_path):
    return sample("acclaim", tmp_path, 40)


def test_it_reads_what_the_library_reads(given):
    recording = AMC.read(given)
    expected = unwrap_angles(walk(40))
    assert np.array_equal(recording.values, expected.values)
    assert (recording.channels, recording.units) == (expected.channels, expected.units)
    assert np.array_equal(recording.times, walk(40).times)
    assert AMC.read(given, rate=30.0).times[3] == 0.1


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_only_what_is_named_changes(given, tmp_path, end):
    text = "# a walk\n" + given.read_text()
    given.write_text(text.replace("\n", end), newline="")
    recording = AMC.read(given)
    replaced = np.zeros(recording.values.shape, dtype=bool)
    replaced[7:9, [0, 61]] = True
    out = tmp_path / "out.amc"
    AMC.write(
        out, recording.with_values(np.where(replaced, 0.125, recording.values)), given, replaced
    )
    before, after = given.read_bytes().splitlines(), out.read_bytes().splitlines()
    changed = [k for k, (one, two) in enumerate(zip(before, after, strict=True)) if one != two]
    first = 3 + 7 * 30
    assert changed == [first + 1, first + 29, first + 31, first + 59]
    for k in changed[::2]:
        assert after[k].split() == [b"root", b"0.125", *before[k].split()[2:]]
    assert after[changed[1]].split()[-1] == b"0.125"


def test_a_file_in_radians_stays_in_radians(tmp_path, given):
    angular = [unit == "deg" for unit in walk(40).units]
    lines = given.read_text().replace(":DEGREES", ":RADIANS").splitlines()
    given.write_text("\n".join(lines) + "\n")
    recording = AMC.read(given)
    assert np.allclose(
        AMC.load(given, None).values[:, angular], np.degrees(walk(40).values[:, angular])
    )
    replaced = np.zeros(recording.values.shape, dtype=bool)
    replaced[7, :4] = True
    filled = recording.with_values(np.where(replaced, 90.0, recording.values))
    AMC.write(tmp_path / "out.amc", filled, given, replaced)
    line = next(k for k, text in enumerate(lines) if text == "8") + 1
    words = (tmp_path / "out.amc").read_text().splitlines()[line].split()
    assert [float(word) for word in words[1:5]] == pytest.approx([90.0, 90.0, 90.0, np.pi / 2])
    assert words[5:] == lines[line].split()[5:]


@pytest.mark.parametrize("name", ["walk.asf", "walk_01.asf", "01.asf", "someone.asf"])
def test_the_skeleton_beside_it_is_found(given, name):
    given.with_suffix(".asf").rename(given.with_name(name))
    motion = given.rename(given.with_name("01_05.amc" if name == "01.asf" else "walk_01.amc"))
    assert AMC.read(motion).channels == walk().channels
    assert AMC.skeleton(motion) == GaitLibrary().skeleton(KEY)


def test_no_skeleton_or_one_of_several_is_said_plainly(given):
    asf = given.with_suffix(".asf")
    text = asf.read_text()
    asf.unlink()
    expected = "expected its skeleton walk.asf beside it, got no .asf file; copy the skeleton of"
    with pytest.raises(FormatError, match=expected):
        AMC.read(given)
    for name in ("a.asf", "b.asf"):
        given.with_name(name).write_text(text)
    with pytest.raises(FormatError, match=r"got 2 other .asf files; copy the skeleton of the same"):
        AMC.read(given)


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        (":FULLY-SPECIFIED", ":SPECIFIED", "expected a header .*; export the motion again"),
        ("\n2\n", "\n3\n", "expected the frame number 2, got '3'; export the motion again"),
        (
            "root ",
            "root nan ",
            "expected .*segment 'root' .*; export .* gaps are named, not written",
        ),
    ],
)
def test_what_is_wrong_is_said_plainly(given, old, new, complaint):
    given.write_text(given.read_text().replace(old, new))
    with pytest.raises(FormatError, match=complaint):
        AMC.read(given)


def test_a_wrong_skeleton_is_named(given):
    given.with_suffix(".asf").write_text("nothing")
    with pytest.raises(
        FormatError, match=r"walk.asf, line 1: expected .*; export the skeleton again"
    ):
        AMC.read(given)


def test_the_incomplete_frame_at_the_end_of_a_capture_stays(given, tmp_path):
    given.write_text("\n".join(given.read_text().splitlines()[:-5]))
    with pytest.warns(UserWarning, match="lacks 5 of its 29 segments"):
        recording = AMC.read(given)
    assert len(recording.times) == 39
    with pytest.warns(UserWarning, match="lacks 5"):
        AMC.write(tmp_path / "out.amc", recording, given)
    assert (tmp_path / "out.amc").read_text() == given.read_text()


@pytest.mark.recordings
@pytest.mark.parametrize("key", ["02_01", "08_01", "35_02"])
def test_recordings_of_the_database(data_dir, cmu, tmp_path, key):
    """08_01 has a thumb that makes whole turns."""
    folder = data_dir / "subjects" / key[:2]
    recording = AMC.read(folder / f"{key}.amc")
    assert np.array_equal(recording.values, unwrap_angles(cmu.recording(f"cmu:{key}")).values)
    replaced = np.zeros(recording.values.shape, dtype=bool)
    replaced[50:80, ::7] = True
    out = tmp_path / f"{key}.amc"
    AMC.write(out, recording, folder / f"{key}.amc", replaced)
    shutil.copy(folder / f"{key[:2]}.asf", tmp_path)
    again, before = AMC.load(out, None), AMC.load(folder / f"{key}.amc", None)
    assert np.array_equal(again.values[~replaced], before.values[~replaced])
    turns = (again.values - before.values)[replaced] / 360.0
    assert np.allclose(turns, np.round(turns), atol=1e-9)
    AMC.write(out, recording, folder / f"{key}.amc")
    assert out.read_bytes() == (folder / f"{key}.amc").read_bytes()
