"""Errors and warnings about Acclaim files, with file, line, expected and found content."""

from __future__ import annotations

__all__ = ["AcclaimError", "TruncatedFrameWarning"]


class AcclaimError(ValueError):
    """An Acclaim file that cannot be read.

    Parameters
    ----------
    file : str
        The file, or the name of the generated text.
    line : int or None
        Line, counted from 1; None if the error concerns the whole file.
    expected : str
        What the format requires there.
    got : str
        What was found instead.
    """

    def __init__(self, file: str, line: int | None, expected: str, got: str) -> None:
        super().__init__(file, line, expected, got)
        self.file = file
        self.line = line
        self.expected = expected
        self.got = got

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}, line {self.line}"
        return f"{place}: expected {self.expected}, got {self.got}"


class TruncatedFrameWarning(UserWarning):
    """The last frame of a motion is incomplete, as the capture was cut short; it was dropped."""
