"""What can be wrong with an Acclaim file, said so that a person can mend it."""

from __future__ import annotations

__all__ = ["AcclaimError", "TruncatedFrameWarning"]


class AcclaimError(ValueError):
    """An Acclaim file that cannot be read.

    Parameters
    ----------
    file : str
        The file, or the name of the generated text.
    line : int or None
        1-based line, or None where the file as a whole is at fault.
    expected : str
        What the format asks for there.
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
    """The last frame of a motion lacks segments, as the capture was cut short; it is dropped."""
