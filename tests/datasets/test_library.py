"""A library in ten lines: what the base class provides."""

from importlib.metadata import entry_points

import numpy as np
import pytest

from mocapbench.datasets import (
    Archive,
    FetchError,
    Library,
    Recording,
    RecordingUnavailable,
    SkeletonUnavailable,
)


class Tables(Library):
    """Comma-separated values of two channels at ten frames a second."""

    def where(self, key):
        file = self.folders[0] / f"{key}.csv"
        return str(file) if file.exists() else ""

    def recording(self, key):
        values = np.loadtxt(self.where(key), delimiter=",", ndmin=2)
        return Recording(key, np.arange(len(values)) / 10, values, ["hip", "knee"], ["deg"] * 2)


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "slow walk.csv"
    file.write_text("1,2\n3,4\n")
    return file


@pytest.fixture
def archive(file):
    return Archive({"tables": Tables(file.parent)})


def test_the_packages_own_libraries_are_found_and_built_like_any_other(tmp_path):
    points = entry_points(group="mocapbench.libraries")
    assert {point.name for point in points} == {"cmu", "files", "gait", "lafan1", "rotations"}
    for point in points:
        library = point.load()(tmp_path)
        assert isinstance(library, Library)
        assert library.folders == (tmp_path,)


def test_an_archive_reads_it(archive, file):
    recording = archive.recording("tables:slow walk")
    assert recording.name == "tables:slow walk"
    np.testing.assert_array_equal(recording.values, [[1, 2], [3, 4]])
    assert archive.status(["tables:slow walk"])[0].where == str(file)


def test_its_digest_is_that_of_the_content(archive, file):
    before = archive.digest("tables:slow walk")
    file.write_text("1.0, 2.0\n3.0, 4.0\n")
    assert archive.digest("tables:slow walk") == before
    file.write_text("1,2\n3,5\n")
    assert archive.digest("tables:slow walk") != before


PLAIN = {
    "times": [0.0, 0.1],
    "values": [[1.0, 2.0], [3.0, 4.0]],
    "channels": ["hip", "knee"],
    "units": ["deg", "deg"],
}
OTHER = {
    "times": [0.0, np.nextafter(0.1, 1.0)],
    "values": [[1.0, 2.0], [3.0, np.nextafter(4.0, 5.0)]],
    "channels": ["hip", "ankle"],
    "units": ["deg", ""],
}


def digest_of(**content):
    class Fixed(Library):
        def where(self, key):
            return "here"

        def recording(self, key):
            return Recording(key, **content)

    assert Fixed().digest("a") == Fixed().digest("b")
    return Fixed().digest("a")


@pytest.mark.parametrize("part", OTHER)
def test_the_digest_depends_on_each_part_of_the_content_and_not_on_the_key(part):
    assert digest_of(**PLAIN) == digest_of(**PLAIN)
    assert digest_of(**PLAIN | {part: OTHER[part]}) != digest_of(**PLAIN)


def test_what_is_here_needs_no_fetching(archive):
    (row,) = archive.fetch(["tables:slow walk"])
    assert (row.state, row.digest) == ("verified", archive.digest("tables:slow walk"))


def test_what_is_not_here_cannot_be_fetched(archive):
    assert archive.advice("tables:run").endswith("name its folder with --data-dir")
    with pytest.raises(RecordingUnavailable, match=r"not on this machine; put it where"):
        archive.recording("tables:run")
    with pytest.raises(FetchError, match=r"run: Tables cannot download .* with --data-dir"):
        archive.fetch(["tables:run"])


def test_a_malformed_file_is_found_by_verifying(archive, file):
    file.write_text("1,2\n3,four\n")
    (row,) = archive.verify(["tables:slow walk"])
    assert row.state == "wrong"
    assert "four" in row.where


def test_it_has_no_skeletons(archive):
    with pytest.raises(SkeletonUnavailable, match="Tables has no skeleton"):
        archive.skeleton("tables:slow walk")
