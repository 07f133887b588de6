"""The generated pages, as text, and tables read back from them."""

import re
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

if not all(map(find_spec, ("sphinx", "numpydoc"))):  # the extra docs is not installed
    collect_ignore_glob = ["test_*.py"]


@pytest.fixture(scope="session")
def goldens():
    """Return the folder of reference values."""
    return ROOT / "tests" / "goldens" / "metrics"


@contextmanager
def leave_out_recordings(cache):
    """Make this a machine without recordings, for as long as the context lasts."""
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("MOCAPBENCH_DATA", raising=False)
        patch.setenv("MOCAPBENCH_CACHE", str(cache))
        yield


@pytest.fixture
def without_recordings(tmp_path):
    """Make this a machine without recordings."""
    with leave_out_recordings(tmp_path):
        yield


@pytest.fixture(scope="session")
def texts(goldens, tmp_path_factory):
    """Return the texts of all pages, by kind and name."""
    with leave_out_recordings(tmp_path_factory.mktemp("cache")):
        return import_module("catalogue.site").pages(goldens)


@pytest.fixture(scope="session")
def tables():
    """Return a function that reads the tables of a page: (title, rows of cells) of each."""
    return _tables


def _tables(text):
    found = []
    for line in text.splitlines():
        begun = re.match(r" *\.\. list-table::(.*)", line)
        if begun:
            found.append((_plain(begun[1].strip()), []))
        elif found and (row := re.match(r" +\* - ?(.*)", line)):
            found[-1][1].append([_plain(row[1])])
        elif found and (cell := re.match(r" +- (.*)", line)) and found[-1][1]:
            found[-1][1][-1].append(_plain(cell[1]))
    return found


def _plain(text):
    """Return a cell as a reader sees it: without escapes, and of a link its text."""
    shown = re.sub(r":doc:`(.*?) <[^>]*>`", r"\1", text)
    return re.sub(r"\\(.)", r"\1", shown)
