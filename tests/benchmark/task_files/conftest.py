from pathlib import Path

import pytest
from own_files import write_csv

from mocapbench.benchmark.task_files.checking import check_document
from mocapbench.benchmark.task_files.document import Document


@pytest.fixture
def folder(tmp_path):
    """A folder of two recordings that are alike."""
    here = tmp_path / "recordings"
    for name in ("a", "b"):
        write_csv(here / f"{name}.csv")
    return here


@pytest.fixture
def check(folder):
    """Return a function that checks the text of a task file against the folder."""

    def check_text(text):
        return check_document(Document("my.toml", text), Path(folder))

    return check_text
