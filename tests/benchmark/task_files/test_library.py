import os

import pytest
from own_files import write_csv

from mocapbench.benchmark.task_files.library import FolderLibrary, address_of
from mocapbench.datasets import Archive, FormatError, RecordingUnavailable, SkeletonUnavailable


@pytest.fixture
def archive(folder):
    write_csv(folder / "below" / "c.csv")
    return Archive({"files": FolderLibrary(folder)})


def test_recordings_have_their_paths_as_keys(archive):
    assert archive.recording("files:below/c.csv").name == "files:below/c.csv"
    assert archive.available("files:a.csv")
    with pytest.raises(RecordingUnavailable):
        archive.recording("files:c.csv")


@pytest.mark.parametrize(
    "key",
    [
        *("../recordings/a.csv", "below/../a.csv", "/etc/hosts"),
        *(r"..\recordings\a.csv", r"below\..\a.csv", r"\a.csv", r"\\server\a.csv"),  # of Windows
    ],
)
def test_nothing_outside_the_folder_is_there(archive, folder, key):
    if os.sep == "/":  # then it is a name
        (folder / key.replace("/", "\\")).touch()
    assert not archive.available(f"files:{key}")
    assert not archive.available(f"files:{folder / 'a.csv'}")


def test_a_rate_takes_the_place_of_times(archive):
    times = archive.recording("files:a.csv?rate=100").times
    assert times[:2].tolist() == [0.0, 0.01]
    assert archive.recording("files:a.csv").times[1] == pytest.approx(0.02)
    assert address_of("a.csv", 100.0) == "files:a.csv?rate=100"


def test_a_digest_is_of_what_the_file_says(archive, folder):
    assert archive.digest("files:a.csv") == archive.digest("files:b.csv")
    assert archive.digest("files:a.csv") != archive.digest("files:a.csv?rate=100")
    write_csv(folder / "b.csv", n_frames=59)
    fresh = Archive({"files": FolderLibrary(folder)})
    assert fresh.digest("files:b.csv") != archive.digest("files:a.csv")


def test_what_cannot_be_had_is_said(archive, folder):
    (folder / "notes.txt").write_text("no recording")
    with pytest.raises(FormatError, match="expected a file of"):
        archive.recording("files:notes.txt")
    with pytest.raises(SkeletonUnavailable):
        archive.skeleton("files:a.csv")
    with pytest.raises(FormatError, match="without ':'"):
        address_of("a:b.csv", None)
