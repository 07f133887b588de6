"""Files of rotation vectors: found in the user's folders, read whole, or made from recordings."""

import gzip

import numpy as np
import pytest
from shared_files import shared

from mocapbench.datasets import (
    Archive,
    CMULibrary,
    FetchError,
    FormatError,
    GaitLibrary,
    RotationLibrary,
    original_recordings,
    place_rotated_joints,
    rotations_of,
)

ROWS = np.arange(3 * 117.0).reshape(3, 117)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "train" / "basketball_signal").mkdir(parents=True)
    return tmp_path


def write(folder, text, end=""):
    path = folder / "train" / "basketball_signal" / f"basketball_signal_2.txt{end}"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def format_rows(rows):
    return "\n".join(",".join(f"{value:.9g}" for value in row) for row in rows) + "\n"


KEY = "train/basketball_signal_2"


def test_a_file_is_found_and_read_at_120_frames_a_second(folder):
    path = write(folder, format_rows(ROWS))
    library = RotationLibrary(folder)
    assert library.where(KEY) == str(path)
    recording = library.recording(KEY)
    np.testing.assert_array_equal(recording.values, ROWS)
    np.testing.assert_allclose(recording.times, [0, 1 / 120, 2 / 120])
    assert recording.channels[:4] == ("path.x", "path.y", "path.z", "Hips.x")


def test_all_have_the_same_joints(folder):
    write(folder, format_rows(ROWS))
    archive = Archive({"rotations": RotationLibrary(folder)})
    assert len(archive.skeleton(f"rotations:{KEY}").segments) == 38


def test_a_compressed_file_is_the_same(folder):
    text = format_rows(ROWS)
    write(folder, text)
    digest = RotationLibrary(folder).digest(KEY)
    (folder / "train" / "basketball_signal" / "basketball_signal_2.txt").unlink()
    write(folder, gzip.compress(text.encode()), ".gz")
    library = RotationLibrary(folder)
    np.testing.assert_array_equal(library.recording(KEY).values, ROWS)
    assert library.digest(KEY) == digest


def test_another_content_has_another_digest(folder):
    digests = set()
    for rows in (ROWS, ROWS + 1):
        write(folder, format_rows(rows))
        digests.add(RotationLibrary(folder).digest(KEY))
    assert len(digests) == 2


def test_what_is_not_here_is_nowhere(folder, monkeypatch, tmp_path_factory):
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path_factory.mktemp("empty")))
    assert {RotationLibrary(folder).where(key) for key in original_recordings()} == {""}


def test_a_key_that_is_no_file_of_the_contest_is_refused(folder):
    with pytest.raises(ValueError, match=r"such as test/walking_1, got 'test/walking_2'"):
        RotationLibrary(folder).where("test/walking_2")


FAULTS = {
    "too few columns": (format_rows(ROWS[:, :5]), r"two rows or more of 117 numbers a row, got"),
    "rows that differ": ("1,2\n1\n", "117 numbers a row, got"),
    "text": (format_rows(ROWS).replace("0,", "x,", 1), "117 numbers a row, got"),
    "nothing": ("", r"two rows or more of 117 numbers a row, got"),
    "not a number": (format_rows(np.where(ROWS == 130, np.nan, ROWS)), r"line 2: expected finite"),
}


@pytest.mark.filterwarnings("ignore:loadtxt")
@pytest.mark.parametrize(("text", "message"), FAULTS.values(), ids=FAULTS)
def test_a_malformed_file_is_named_with_what_was_expected(folder, text, message):
    write(folder, text)
    with pytest.raises(FormatError, match=message):
        RotationLibrary(folder).recording(KEY)


def test_a_file_that_is_not_compressed_as_it_says_is_named(folder):
    write(folder, b"no gzip", ".gz")
    with pytest.raises(FormatError, match="compressed by gzip"):
        RotationLibrary(folder).recording(KEY)


def test_what_is_made_from_a_recording_has_one_row_more_that_is_the_rest_pose():
    library = GaitLibrary()
    walk = library.recording("01_01")
    made = rotations_of(walk, library.skeleton("01_01"))
    assert len(made.times) == len(walk.times) + 1
    np.testing.assert_allclose(np.diff(made.times), np.diff(walk.times)[0])
    np.testing.assert_allclose(made.values[0, :3], walk.values[0, :3], atol=1e-4)
    np.testing.assert_allclose(made.values[1:, :3], walk.values[:, :3], atol=1e-4)
    assert np.rad2deg(made.values[0, 3:].sum()) == pytest.approx(16 - 21 - 11)


def test_the_recording_that_a_file_was_made_from_is_downloaded(tmp_path, monkeypatch):
    fetched = []
    monkeypatch.setattr(CMULibrary, "where", lambda self, key: "")
    monkeypatch.setattr(CMULibrary, "fetch", lambda self, key: fetched.append(key))
    library = RotationLibrary(tmp_path)
    library.fetch("test/jumping_1")
    assert fetched == [original_recordings()["test/jumping_1"]]
    assert library.advice("test/jumping_1") == ""
    with pytest.raises(FetchError, match=r"not known .*; name the folder cmu_mocap"):
        library.fetch("test/basketball_1")
    assert len(fetched) == 1


def test_recordings_of_another_skeleton_are_refused():
    library = GaitLibrary()
    skeleton = library.skeleton("01_01")
    walk = library.recording("01_01")
    part = type(skeleton)(skeleton.name, skeleton.length_unit, skeleton.segments[:5])
    with pytest.raises(ValueError, match=r"expected the segments of the CMU database, got none"):
        rotations_of(walk, part)


@pytest.mark.parametrize(
    "key", [key for key, original in original_recordings().items() if original]
)
def test_files_follow_from_the_database_to_what_no_score_shows(key):
    database, original = CMULibrary(), original_recordings()[key]
    if not database.where(original):
        pytest.skip(f"cmu:{original} is in no folder of MOCAPBENCH_DATA")
    files = RotationLibrary(shared("cmu-prediction", "data"))
    if not files.where(key).partition(".")[2].startswith("txt"):
        pytest.skip(f"{key} is in no folder ../shared")
    file = files.recording(key).values
    made = rotations_of(database.recording(original), database.skeleton(original)).values
    assert made.shape == file.shape
    assert np.abs(made[:, 3:] - file[:, 3:]).max() < 4e-6
    assert np.abs(place_rotated_joints(made) - place_rotated_joints(file)).max() * 70 < 0.005
