"""Folders of recordings that the user names: those that hold none are refused."""

import pytest

from mocapbench.benchmark.archives import archive_at, require_recordings
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES
from mocapbench.datasets import GaitLibrary

LAYOUT = r"subjects/\*/\*\.asf, subjects/\*/\*\.amc, .*"


def check(*folders):
    require_recordings(folders, archive_at(*folders))


@pytest.fixture
def database(tmp_path):
    """A folder laid out as the database is."""
    folder = tmp_path / "database"
    (folder / "subjects" / "99").mkdir(parents=True)
    (folder / "subjects" / "99" / "99_01.amc").touch()
    return folder


@pytest.fixture
def empty(tmp_path):
    folder = tmp_path / "elsewhere" / "empty"
    folder.mkdir(parents=True)
    return folder


def test_a_folder_laid_out_as_expected_is_taken(database):
    check(database)


def test_without_a_folder_none_is_looked_for_and_a_wrong_one_is_refused(empty):
    assert require_recordings((), archive_at()) is None
    with pytest.raises(UsageError):
        require_recordings([empty], archive_at(empty))


def test_an_empty_folder_is_said_to_be_empty_with_the_layout_expected(empty):
    with pytest.raises(UsageError, match=rf"\({LAYOUT}\).*empty', which is empty; name the one"):
        check(empty)


@pytest.mark.parametrize("other", ["notes.txt", "subjects", "99_01.amc"])
def test_a_folder_of_other_things_is_said_to_hold_none(empty, other):
    (empty / other).touch()
    with pytest.raises(UsageError, match="which holds none"):
        check(empty)


@pytest.mark.parametrize("where", [".", "subjects"])
def test_the_folder_above_or_below_is_suggested(database, where):
    named = database.parent if where == "." else database / where
    with pytest.raises(UsageError, match=f"; name {database.resolve()}, or none to download"):
        check(named)


def test_one_of_several_folders_suffices(database, empty):
    check(empty, database)
    (empty.parent / "other").mkdir()
    with pytest.raises(UsageError, match=r"empty', which is empty, .*other', which is empty"):
        check(empty, empty.parent / "other")


def test_a_library_of_ones_own_says_what_it_reads(empty):
    class Tables(GaitLibrary):
        layout = ("*.csv",)

    LIBRARIES.add("tables", Tables)
    with pytest.raises(UsageError, match=r"\*\.csv"):
        check(empty)
    (empty / "walk.csv").touch()
    check(empty)
