"""The archive: one address for every recording, and what can be said of it."""

import pickle

import numpy as np
import pytest

from mocapbench.datasets import (
    Archive,
    DigestMismatch,
    Library,
    Motion,
    RecordingUnavailable,
    open_archive,
)


class Shelf(Library):
    """Holds 01_01, holds a wrong 01_02, and has nothing else until it is fetched."""

    def __init__(self, motion):
        self.motion = motion
        self.here = {"01_01", "01_02"}

    def where(self, key):
        return f"shelf/{key}" if key in self.here else ""

    def read(self, key):
        self.digest(key)
        return self.motion

    def digest(self, key):
        if key == "01_02":
            raise DigestMismatch(self.where(key), "right", "wrong")
        return f"digest of {key}"

    def fetch(self, key):
        self.here.add(key)


@pytest.fixture
def motion(skeleton):
    return Motion(skeleton, tuple(skeleton.moving), np.zeros((2, 12)))


@pytest.fixture
def archive(motion):
    return Archive({"shelf": Shelf(motion)})


def test_an_address_leads_to_the_library(archive, motion):
    assert archive.available("shelf:01_01")
    assert archive.read("shelf:01_01") is motion
    assert archive.digest("shelf:01_01") == "digest of 01_01"


def test_what_is_not_here_comes_with_the_command_that_gets_it(archive):
    assert not archive.available("shelf:01_03")
    for ask in (archive.read, archive.digest):
        with pytest.raises(RecordingUnavailable, match="mocapbench data fetch 01_03") as caught:
            ask("shelf:01_03")
        assert caught.value.uri == "shelf:01_03"


def test_that_error_can_be_pickled():
    error = pickle.loads(pickle.dumps(RecordingUnavailable("cmu:01_01", "get it")))
    assert (error.uri, error.command) == ("cmu:01_01", "get it")


@pytest.mark.parametrize("uri", ["01_01", "attic:01_01", ""])
def test_an_unknown_library_is_refused(archive, uri):
    with pytest.raises(ValueError, match="one of shelf"):
        archive.available(uri)


def test_status_tells_what_is_here(archive):
    assert archive.status(["shelf:01_01", "shelf:01_03"]) == [
        ("shelf:01_01", "available", "shelf/01_01", ""),
        ("shelf:01_03", "missing", "", ""),
    ]


def test_verify_tells_right_from_wrong_and_missing(archive):
    right, wrong, missing = archive.verify(["shelf:01_01", "shelf:01_02", "shelf:01_03"])
    assert right == ("shelf:01_01", "verified", "shelf/01_01", "digest of 01_01")
    assert (wrong.state, missing.state) == ("wrong", "missing")
    assert "right" in wrong.where
    assert "wrong" in wrong.where


def test_fetch_gets_what_is_missing_and_verifies_it(archive):
    assert archive.fetch(iter(["shelf:01_03"])) == [
        ("shelf:01_03", "verified", "shelf/01_03", "digest of 01_03")
    ]


def test_the_whole_archive_serves_generated_gait_without_any_data(tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_DATA", raising=False)
    archive = open_archive(cache_dir=tmp_path)
    assert archive.available("gait:01_01")
    assert not archive.available("cmu:01_01")


def test_folders_come_from_the_environment(tmp_path, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path / "cache"))
    for folder, subject in (("data", "01"), ("cache", "02")):
        tree = tmp_path / folder / "subjects" / subject
        tree.mkdir(parents=True)
        (tree / f"{subject}.asf").touch()
        (tree / f"{subject}_01.amc").touch()
    assert open_archive().available("cmu:01_01")
    assert open_archive().available("cmu:02_01")


@pytest.mark.recordings
def test_real_recordings_are_the_registered_ones(cmu):
    rows = cmu.verify(["cmu:02_01", "cmu:11_01", "cmu:12_01"])
    assert [row.state for row in rows] == ["verified"] * 3
