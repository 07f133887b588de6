"""The archive: one address for every recording, whatever its library."""

import pickle

import numpy as np
import pytest

from mocapbench.datasets import (
    Archive,
    DigestMismatch,
    Library,
    Recording,
    RecordingUnavailable,
    SkeletonUnavailable,
    open_archive,
)


class Shelf(Library):
    """Holds 01_01, a wrong 01_02 and a damaged 01_04; the others can be fetched."""

    def __init__(self):
        super().__init__()
        self.here = {"01_01", "01_02", "01_04"}

    def where(self, key):
        return f"shelf/{key}" if key in self.here else ""

    def recording(self, key):
        self.digest(key)
        if key == "01_04":
            raise OSError("cannot be read")
        return Recording(key, [0.0, 0.1], np.zeros((2, 1)), ["x"], ["deg"])

    def digest(self, key):
        if key == "01_02":
            raise DigestMismatch(self.where(key), "right", "wrong")
        return f"digest of {key}"

    def fetch(self, key):
        self.here.add(key)


@pytest.fixture
def archive():
    return Archive({"shelf": Shelf()})


def test_an_address_leads_to_the_library(archive):
    assert archive.available("shelf:01_01")
    assert archive.recording("shelf:01_01").channels == ("x",)
    assert archive.digest("shelf:01_01") == "digest of 01_01"


def test_a_library_that_can_download_has_no_advice(archive):
    assert archive.advice("shelf:01_03") == ""


def test_a_recording_is_named_by_its_address(archive):
    assert archive.recording("shelf:01_01").name == "shelf:01_01"


def test_a_skeleton_is_that_of_the_library(archive, skeleton, monkeypatch):
    with pytest.raises(SkeletonUnavailable, match="Shelf has no skeleton for recording '01_01'"):
        archive.skeleton("shelf:01_01")
    monkeypatch.setattr(Shelf, "skeleton", lambda self, key: skeleton)
    assert archive.skeleton("shelf:01_01") is skeleton


def test_what_is_not_here_comes_with_the_command_that_gets_it(archive):
    assert not archive.available("shelf:01_03")
    for method in (archive.recording, archive.skeleton, archive.digest):
        with pytest.raises(
            RecordingUnavailable, match=r"get it with: mocapbench data fetch shelf:01_03$"
        ) as caught:
            method("shelf:01_03")
        assert caught.value.uri == "shelf:01_03"


def test_the_command_names_every_library_but_cmu_and_can_be_pasted():
    assert Archive.fetch_command("cmu:35_02", "gait:01_01", "shelf:a walk") == (
        "mocapbench data fetch 35_02 gait:01_01 'shelf:a walk'"
    )


@pytest.mark.parametrize(
    "error",
    [RecordingUnavailable("cmu:01_01", "get it"), SkeletonUnavailable("01_01", "Shelf")],
    ids=lambda error: type(error).__name__,
)
def test_its_errors_can_be_pickled(error):
    again = pickle.loads(pickle.dumps(error))
    assert (vars(again), str(again)) == (vars(error), str(error))


@pytest.mark.parametrize("uri", ["01_01", "attic:01_01", ""])
def test_an_unknown_library_is_refused(archive, uri):
    with pytest.raises(ValueError, match="one of shelf"):
        archive.available(uri)


@pytest.mark.parametrize("uri", ["shelf:", "shelf", "shelf:a:b"])
def test_a_key_is_text_without_a_colon(archive, uri):
    with pytest.raises(ValueError, match="expected LIBRARY:KEY, LIBRARY one of shelf"):
        archive.recording(uri)


def test_status_lists_what_is_here(archive):
    assert archive.status(["shelf:01_01", "shelf:01_03"]) == [
        ("shelf:01_01", "available", "shelf/01_01", ""),
        ("shelf:01_03", "missing", "", ""),
    ]


def test_verify_separates_right_wrong_missing_and_damaged_recordings(archive):
    right, wrong, missing, damaged = archive.verify(
        [f"shelf:{key}" for key in ("01_01", "01_02", "01_03", "01_04")]
    )
    assert right == ("shelf:01_01", "verified", "shelf/01_01", "digest of 01_01")
    assert (wrong.state, missing.state) == ("wrong", "missing")
    assert "right" in wrong.where
    assert "wrong" in wrong.where
    assert (damaged.state, damaged.where) == ("wrong", "cannot be read")


def test_fetch_gets_what_is_missing_and_verifies_it(archive):
    assert archive.fetch(iter(["shelf:01_03"])) == [
        ("shelf:01_03", "verified", "shelf/01_03", "digest of 01_03")
    ]


def test_synthetic_gait_is_available_without_any_data(tmp_path, monkeypatch):
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


def test_the_cache_is_the_users_where_none_is_named(tmp_path, monkeypatch):
    monkeypatch.delenv("MOCAPBENCH_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert open_archive().libraries["cmu"].cache_dir == tmp_path / "mocapbench"


@pytest.mark.recordings
def test_a_skeleton_of_real_recordings_is_that_of_the_motion(cmu):
    assert cmu.skeleton("cmu:35_02") == cmu.libraries["cmu"].motion("35_02").skeleton


@pytest.mark.recordings
def test_real_recordings_are_the_registered_ones(cmu):
    rows = cmu.verify(["cmu:02_01", "cmu:11_01", "cmu:12_01"])
    assert [row.state for row in rows] == ["verified"] * 3
