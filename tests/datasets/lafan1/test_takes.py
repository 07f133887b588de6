"""The file of LaFAN1: takes of a subject, and files that are another, damaged or absent."""

from hashlib import sha256
from zipfile import ZipFile

import numpy as np
import pytest
from lafan1_files import JOINTS, OFFSETS, PARENTS, write_take, write_zip

from mocapbench.datasets import DigestMismatch, FetchError, FormatError, LaFAN1Library
from mocapbench.datasets.lafan1.hierarchy import parse_hierarchy
from mocapbench.datasets.lafan1.windows import offsets_of


def make_take(subject, take, n_frames):
    """Return a body at rest on a path of its own, with another number in every angle."""
    path = np.full((n_frames, 3), 10.0 * subject + take)
    return path, np.arange(n_frames * 66.0).reshape(n_frames, 22, 3) % 50


def open_library(folder):
    digest = sha256((folder / "lafan1.zip").read_bytes()).hexdigest()
    return LaFAN1Library(folder, expected=digest)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data")
    write_zip(folder / "lafan1.zip", make_take, lengths=(6, 4))
    return folder


def test_a_recording_is_all_takes_of_a_subject_with_a_pause_between(folder):
    library = open_library(folder)
    recording = library.recording("subject3")
    assert recording.values.shape == (10, 3 + 66)
    np.testing.assert_allclose(recording.values[:, 0], [31] * 6 + [32] * 4)
    np.testing.assert_allclose(np.diff(recording.times), [1 / 30] * 5 + [1] + [1 / 30] * 3, 1e-4)
    assert recording.channels[:6] == (
        "Hips.tx",
        "Hips.ty",
        "Hips.tz",
        "Hips.rz",
        "Hips.ry",
        "Hips.rx",
    )


def test_joints_are_those_of_the_file_with_the_root_at_its_path(folder):
    skeleton = open_library(folder).skeleton("subject1")
    assert [segment.name for segment in skeleton.segments] == JOINTS
    assert {s.name: s.parent for s in skeleton.segments} == PARENTS
    expected = [(0, 0, 0), *(OFFSETS[name] for name in JOINTS[1:])]
    np.testing.assert_allclose(offsets_of(skeleton), expected)
    assert skeleton.centimetres_per_unit == 1


def test_a_digest_is_of_the_file_and_the_subject(folder):
    library = open_library(folder)
    assert library.digest("subject1") == f"{library.expected} subject1"


def test_another_file_is_refused(folder):
    library = LaFAN1Library(folder)
    for read in (library.recording, library.skeleton, library.digest):
        with pytest.raises(DigestMismatch, match="ea918082b500a5d158e9d3aa39039df04cd42e25"):
            read("subject1")


def test_where_the_file_is_absent_it_says_where_to_get_it(tmp_path):
    library = LaFAN1Library(tmp_path)
    assert library.where("subject5") == ""
    with pytest.raises(FetchError, match=r"ubisoft-laforge-animation-dataset.*--data-dir"):
        library.fetch("subject5")


def test_what_is_here_needs_no_fetching(folder):
    open_library(folder).fetch("subject5")


@pytest.mark.parametrize("key", ["subject6", "walk1_subject5", ""])
def test_a_key_that_is_no_subject_is_refused(folder, key):
    with pytest.raises(ValueError, match="subject1 to subject5"):
        open_library(folder).where(key)


def test_a_file_that_is_no_zip_or_lacks_a_subject_is_refused(tmp_path):
    (tmp_path / "lafan1.zip").write_text("no zip")
    with pytest.raises(FormatError, match=r"lafan1\.zip: expected a zip file"):
        open_library(tmp_path).recording("subject1")
    with ZipFile(tmp_path / "lafan1.zip", "w") as archive:
        archive.writestr("walk1_subject1.bvh", write_take(*make_take(1, 1, 3)))
    with pytest.raises(FormatError, match=r"takes called \*_subject2\.bvh"):
        open_library(tmp_path).recording("subject2")


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ([], "joints with their offsets"),
        (["ROOT Hips", "{", "OFFSET 1 2"], "an OFFSET of Hips with three numbers, got 1 2"),
        (["ROOT Hips", "{", "OFFSET 1 2 x"], "an OFFSET of Hips with three numbers"),
    ],
)
def test_a_hierarchy_without_offsets_is_refused(lines, expected):
    with pytest.raises(FormatError, match=f"walk.bvh: expected {expected}"):
        parse_hierarchy(lines, "walk.bvh")
