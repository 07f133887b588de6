import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.store import Store


def test_a_folder_that_is_not_ours_is_refused(tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(UsageError, match="name a new or empty folder"):
        Store.create(tmp_path)
    with pytest.raises(UsageError, match="is not a mocapbench run"):
        Store.open(tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]


def test_a_file_in_place_of_the_folder_is_refused(tmp_path):
    path = tmp_path / "file"
    path.touch()
    with pytest.raises(UsageError, match="expected a folder"):
        Store.create(path)
