"""Digests of files ignore line ends; unknown ones are pinned when first seen."""

import pickle
import warnings

import pytest

from mocapbench.datasets import DigestMismatch, UnregisteredDigestWarning, registered_digests
from mocapbench.datasets.digests import DigestRegistry, read_digests

ABC = "edeaaff3f1774ad2888673770c6d64097e391bc362d7d6fb34982ddf0efd18cb"  # of b"abc\n"


RENEWAL = "mocapbench data renew a"


def accept(registry, content, file="a.amc"):
    """Check a file, and record it if it is new."""
    if registry.check("a.amc", content, file, RENEWAL):
        registry.record("a.amc", content, file)


@pytest.fixture
def pins(tmp_path):
    return tmp_path / "cache" / "digests.tsv"


def test_a_known_file_passes_with_either_line_end(pins):
    registry = DigestRegistry({"a.amc": ABC}, pins)
    accept(registry, b"abc\n")
    accept(registry, b"abc\r\n")
    assert not pins.exists()


def test_a_mismatch_names_the_file_and_both_digests(pins):
    with pytest.raises(DigestMismatch) as caught:
        accept(DigestRegistry({"a.amc": ABC}, pins), b"abx\n", "folder/a.amc")
    assert (caught.value.file, caught.value.expected) == ("folder/a.amc", ABC)
    for part in ("folder/a.amc", ABC, caught.value.got, "fetch it again"):
        assert part in str(caught.value)


def test_the_digest_of_an_unknown_file_is_pinned_with_a_warning(pins):
    with pytest.warns(UnregisteredDigestWarning, match=ABC):
        accept(DigestRegistry({}, pins), b"abc\n")
    later = DigestRegistry({}, pins)
    accept(later, b"abc\r\n")
    with pytest.raises(DigestMismatch, match=ABC):
        accept(later, b"abx\n")


def test_every_copy_of_a_diverse_file_is_accepted_with_one_warning(pins):
    registry = DigestRegistry({}, pins, {"a.amc"})
    for content in (b"abc\n", b"abx\n"):
        with pytest.warns(UnregisteredDigestWarning, match="not pinned: different copies"):
            accept(registry, content)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            accept(registry, content)


def test_a_known_digest_overrules_a_pinned_one(pins):
    with pytest.warns(UnregisteredDigestWarning):
        accept(DigestRegistry({}, pins), b"wrong\n")
    accept(DigestRegistry({"a.amc": ABC}, pins), b"abc\n")


def test_nothing_is_pinned_in_a_cache_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way of a folder")
    registry = DigestRegistry({}, tmp_path / "file" / "digests.tsv")
    with pytest.warns(UnregisteredDigestWarning):
        accept(registry, b"abc\n")


def test_a_recorded_digest_can_be_forgotten_and_the_message_says_how(pins):
    registry = DigestRegistry({}, pins)
    with pytest.warns(UnregisteredDigestWarning):
        accept(registry, b"abc\n")
        registry.record("b.amc", b"b\n", "b.amc")
    with pytest.raises(DigestMismatch, match=RENEWAL):
        accept(registry, b"abx\n")
    registry.forget({"a.amc", "c.amc"})
    assert list(read_digests(pins)) == ["b.amc"]
    with pytest.warns(UnregisteredDigestWarning):
        accept(registry, b"abx\n")


def test_a_registered_digest_is_never_renewed(pins):
    with pytest.raises(DigestMismatch) as caught:
        accept(DigestRegistry({"a.amc": ABC}, pins), b"abx\n")
    assert RENEWAL not in str(caught.value)


def test_incomplete_rows_of_a_killed_process_are_skipped(tmp_path):
    table = tmp_path / "digests.tsv"
    table.write_text(f"path\tsha256\na.amc\t{ABC}\nb.amc\t{ABC[:10]}")
    assert read_digests(table) == {"a.amc": ABC}


def test_the_packaged_registry_lists_the_database():
    known = registered_digests()
    assert len(known) == 286
    assert known["subjects/02/02.asf"].startswith("c50c9cf2")


def test_a_mismatch_can_be_pickled():
    error = pickle.loads(pickle.dumps(DigestMismatch("a.amc", "x", "y", "do")))
    assert (error.file, error.expected, error.got) == ("a.amc", "x", "y")
