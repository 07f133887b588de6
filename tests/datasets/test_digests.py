"""Digests of files ignore line ends; unknown ones are pinned when first seen."""

import pickle
import warnings

import pytest

from mocapbench.datasets import DigestMismatch, UnregisteredDigestWarning, registered_digests
from mocapbench.datasets.digests import DigestRegistry, read_digests

ABC = "edeaaff3f1774ad2888673770c6d64097e391bc362d7d6fb34982ddf0efd18cb"  # of b"abc\n"


@pytest.fixture
def pins(tmp_path):
    return tmp_path / "cache" / "digests.tsv"


def test_a_known_file_passes_with_either_line_end(pins):
    registry = DigestRegistry({"a.amc": ABC}, pins)
    registry.check("a.amc", b"abc\n", "a.amc")
    registry.check("a.amc", b"abc\r\n", "a.amc")
    assert not pins.exists()


def test_a_mismatch_names_the_file_and_both_digests(pins):
    with pytest.raises(DigestMismatch) as caught:
        DigestRegistry({"a.amc": ABC}, pins).check("a.amc", b"abx\n", "folder/a.amc")
    assert (caught.value.file, caught.value.expected) == ("folder/a.amc", ABC)
    for part in ("folder/a.amc", ABC, caught.value.got, "fetch it again"):
        assert part in str(caught.value)


def test_the_digest_of_an_unknown_file_is_pinned_with_a_warning(pins):
    with pytest.warns(UnregisteredDigestWarning, match=ABC):
        DigestRegistry({}, pins).check("a.amc", b"abc\n", "a.amc")
    later = DigestRegistry({}, pins)
    later.check("a.amc", b"abc\r\n", "a.amc")
    with pytest.raises(DigestMismatch, match=ABC):
        later.check("a.amc", b"abx\n", "a.amc")


def test_every_copy_of_a_diverse_file_is_accepted_with_one_warning(pins):
    registry = DigestRegistry({}, pins, {"a.amc"})
    for content in (b"abc\n", b"abx\n"):
        with pytest.warns(UnregisteredDigestWarning, match="not pinned: different copies"):
            registry.check("a.amc", content, "a.amc")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            registry.check("a.amc", content, "a.amc")


def test_a_known_digest_overrules_a_pinned_one(pins):
    with pytest.warns(UnregisteredDigestWarning):
        DigestRegistry({}, pins).check("a.amc", b"wrong\n", "a.amc")
    DigestRegistry({"a.amc": ABC}, pins).check("a.amc", b"abc\n", "a.amc")


def test_nothing_is_pinned_in_a_cache_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way of a folder")
    registry = DigestRegistry({}, tmp_path / "file" / "digests.tsv")
    with pytest.warns(UnregisteredDigestWarning):
        registry.check("a.amc", b"abc\n", "a.amc")


def test_incomplete_rows_of_a_killed_process_are_skipped(tmp_path):
    table = tmp_path / "digests.tsv"
    table.write_text(f"path\tsha256\na.amc\t{ABC}\nb.amc\t{ABC[:10]}")
    assert read_digests(table) == {"a.amc": ABC}


def test_the_packaged_registry_lists_the_database():
    known = registered_digests()
    assert len(known) == 180
    assert known["subjects/02/02.asf"].startswith("c50c9cf2")


def test_a_mismatch_can_be_pickled():
    error = pickle.loads(pickle.dumps(DigestMismatch("a.amc", "x", "y")))
    assert (error.file, error.expected, error.got) == ("a.amc", "x", "y")
