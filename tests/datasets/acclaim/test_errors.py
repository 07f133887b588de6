"""Errors name file, line, expected and got, and can be pickled."""

import pickle

from mocapbench.datasets import AcclaimError


def test_it_names_place_expected_and_got():
    error = AcclaimError("a.amc", 7, "a number", "'x'")
    assert str(error) == "a.amc, line 7: expected a number, got 'x'"
    assert isinstance(error, ValueError)


def test_without_a_line_it_names_the_file():
    assert str(AcclaimError("a.amc", None, "a file", "a folder")).startswith("a.amc: expected")


def test_it_can_be_pickled():
    error = pickle.loads(pickle.dumps(AcclaimError("a.amc", 7, "a number", "'x'")))
    assert (error.file, error.line, error.expected, error.got) == ("a.amc", 7, "a number", "'x'")
