"""What records keep of exceptions is short, whatever these say."""

import math

import pytest

from mocapbench.benchmark.messages import reason, traceback_of


def _raised(error):
    try:
        raise error
    except type(error) as caught:
        return caught


@pytest.mark.parametrize("n", [0, 1, 1000, 1900])
def test_a_message_is_kept_as_it_is(n):
    assert reason(ValueError("x" * n)) == f"ValueError: {'x' * n}"


@pytest.mark.parametrize("n", [3000, 10**6])
def test_of_a_long_message_the_beginning_and_the_end_are_kept(n):
    error = _raised(ValueError(f"begins {'x' * n} ends"))
    for text, most in ((reason(error), 2003), (traceback_of(error), 20003)):
        assert len(text) <= most
        assert text.rstrip().endswith(" ends")
    assert reason(error).startswith("ValueError: begins x")
    assert "…" in reason(error)
    assert "in _raised" in traceback_of(error)


class SilentError(Exception):
    def __init__(self, text):
        super().__init__()
        self.text = text

    def __str__(self):
        if isinstance(self.text, BaseException):
            raise self.text
        return self.text


@pytest.mark.parametrize(
    "text", [ValueError("no text"), SystemExit(0), SilentError(KeyError()), math.pi]
)
def test_an_error_without_a_readable_message_is_named(text):
    error = _raised(SilentError(text))
    assert reason(error) == "SilentError, whose message cannot be read"
    assert "SilentError" in traceback_of(error)
