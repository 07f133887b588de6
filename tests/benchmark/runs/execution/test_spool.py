"""Recordings are read once, and what comes back is the same and cannot be changed."""

import dataclasses
import pickle

import numpy as np
import pytest

from mocapbench.benchmark.runs.execution import spool as spool_module
from mocapbench.benchmark.runs.execution.spool import Spool, SpooledArchive
from mocapbench.datasets import Archive, GaitLibrary, Library, SkeletonUnavailable

URI = "gait:01_01"


class Counting(GaitLibrary):
    """Counts how often a recording is read."""

    def __init__(self):
        super().__init__()
        self.read = 0

    def recording(self, key):
        self.read += 1
        return super().recording(key)


class Broken(Library):
    def where(self, key):
        return "here"

    def recording(self, key):
        raise RuntimeError("cannot be read")


@pytest.fixture
def library():
    return Counting()


@pytest.fixture
def spooled(library, tmp_path):
    libraries = {"gait": library}
    digests = {URI: Archive(libraries).digest(URI)}
    spool = Spool(tmp_path)
    for _ in range(3):
        spool.add(Archive(libraries), digests)
    return SpooledArchive(libraries, spool, digests)


def test_it_is_read_once(spooled, library):
    for _ in range(3):
        spooled.recording(URI)
    assert library.read == 1


def test_a_process_loads_it_once(spooled):
    first = spooled.recording(URI)
    spooled.spool.path(URI, spooled.digests[URI]).write_bytes(b"not read again")
    assert spooled.recording(URI) is first


def cut(archive, uri, first, n_frames):
    return archive.recording(uri).frames(np.arange(first, first + n_frames))


@pytest.fixture
def derived(monkeypatch):
    monkeypatch.setattr(spool_module, "_derived", {})
    return spool_module._derived


def test_what_is_derived_is_kept_by_function_arguments_and_digest(spooled, derived):
    first = spooled.derive(URI, cut, 3, 10)
    assert spooled.derive(URI, cut, 3, 10) is first
    np.testing.assert_array_equal(first.values, spooled.recording(URI).values[3:13])
    other = spooled.derive(URI, cut, 4, 10)
    np.testing.assert_array_equal(other.values, spooled.recording(URI).values[4:14])
    again = SpooledArchive(spooled.libraries, spooled.spool, {URI: "another"})
    assert again.derive(URI, cut, 3, 10) is not first


def test_of_what_is_derived_the_last_that_was_asked_for_is_kept(spooled, derived, monkeypatch):
    monkeypatch.setattr(spool_module, "_MOST_DERIVED", 2 * 10 * 62 * 8)
    first, second = (spooled.derive(URI, cut, start, 10) for start in (0, 1))
    spooled.derive(URI, cut, 0, 10)
    third = spooled.derive(URI, cut, 2, 10)
    assert [*derived.values()] == [first, third]
    assert spooled.derive(URI, cut, 1, 10) is not second
    large = spooled.derive(URI, cut, 0, 50)
    assert [*derived.values()] == [large]


def test_what_comes_back_is_the_same(spooled, library):
    original, copy = Archive({"gait": library}).recording(URI), spooled.recording(URI)
    for field in dataclasses.fields(original):
        np.testing.assert_array_equal(getattr(copy, field.name), getattr(original, field.name))
    assert spooled.skeleton(URI) == library.skeleton("01_01")


def test_no_copy_can_be_changed(spooled):
    for recording in (spooled.recording(URI), pickle.loads(pickle.dumps(spooled.recording(URI)))):
        for array in (recording.values, recording.times):
            with pytest.raises(ValueError, match="cannot set WRITEABLE flag"):
                array.setflags(write=True)


def test_a_recording_that_is_not_in_it_comes_from_its_library(spooled, library):
    assert spooled.recording("gait:01_02").name == "gait:01_02"
    assert library.read == 2


def test_another_digest_is_another_recording(spooled):
    assert spooled.spool.load(URI, "another") is None


def test_what_cannot_be_read_is_left_to_the_job_that_wants_it(tmp_path):
    libraries = {"broken": Broken()}
    Spool(tmp_path).add(Archive(libraries), {"broken:a": "digest"})
    assert not [*tmp_path.iterdir()]
    with pytest.raises(RuntimeError, match="cannot be read"):
        SpooledArchive(libraries, Spool(tmp_path), {"broken:a": "digest"}).recording("broken:a")


class Bare(GaitLibrary):
    """Has no skeletons, and is not everywhere."""

    here = True

    def where(self, key):
        return super().where(key) if self.here else ""

    def skeleton(self, key):
        raise SkeletonUnavailable(key, "Bare")


def test_that_there_is_no_skeleton_is_known_where_the_library_is_not(tmp_path):
    library, digests = Bare(), {URI: "digest"}
    Spool(tmp_path).add(Archive({"gait": library}), digests)
    library.here = False
    elsewhere = SpooledArchive({"gait": library}, Spool(tmp_path), digests)
    assert elsewhere.recording(URI).name == URI
    with pytest.raises(SkeletonUnavailable):
        elsewhere.skeleton(URI)
