"""Errors name file, line, expected and got, and survive the way between processes."""

import pickle

from mocapbench.datasets import AcclaimError


def test_it_says_where_what_was_expected_and_what_was_got():
    error = AcclaimError("a.amc", 7, "a number", "'x'")
    assert str(error) == "a.amc, line 7: expected a number, got 'x'"
    assert isinstance(error, ValueError)


def test_without_a_line_it_speaks_of_the_file():
    assert str(AcclaimError("a.amc", None, "a file", "a folder")).startswith("a.amc: expected")


def test_it_can_be_pickled():
    error = pickle.loads(pickle.dumps(AcclaimError("a.amc", 7, "a number", "'x'")))
    assert (error.file, error.line, error.expected, error.got) == ("a.amc", 7, "a number", "'x'")
