"""Which names every system takes, and which paths stay below a folder on every system."""

import pytest

from mocapbench.benchmark.files import is_file_name, is_path_below
from mocapbench.benchmark.foreign_files import ForeignFileError, Key, fit_schema

DEVICES = ["CON", "nul", "Aux.csv", "prn.tar.gz", "COM1", "lpt9.txt", "com¹", "con .txt"]


@pytest.mark.parametrize(
    "name", [*DEVICES, "", ".", "..", "a/b", r"a\b", "C:", "a?", "a.", "a ", "a\n"]
)
def test_some_names_are_no_names_on_windows(name):
    assert not is_file_name(name)


@pytest.mark.parametrize(
    "name", ["console", "nulls.csv", "com", "com10", "aux-2", ".a", "Fuß [1].csv"]
)
def test_others_are_names_everywhere(name):
    assert is_file_name(name)


@pytest.mark.parametrize(
    "path", [r"a\..\b", r"\a", r"C:\a", "C:a", r"\\a\b", "../a", "/a", r"a/..\b"]
)
def test_some_paths_lead_elsewhere(path):
    assert not is_path_below(path)


@pytest.mark.parametrize("path", ["a", "a/b", r"a\b", "a..b", "a/...", "[a].csv"])
def test_others_stay_below_the_folder(path):
    assert is_path_below(path)


@pytest.mark.parametrize(
    "key", [r"..\a", r"a\..\b", "C:a", "a:b", "/a", ".a", 'a"', "a|b", "a*", "a?"]
)
def test_a_key_of_a_run_names_a_file_of_its_folder(key):
    with pytest.raises(ForeignFileError):
        fit_schema(key, Key)


@pytest.mark.parametrize("key", ["0a" * 32, "A b", "a.b-c_d", "a+,;=@[]{}~^!#$%&'()"])
def test_a_key_is_any_other_text_of_ascii(key):
    fit_schema(key, Key)
