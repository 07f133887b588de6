"""Errors of users' own files: what was expected, what was got, and what to do."""

from __future__ import annotations

__all__ = ["FormatError", "FormatWarning", "MissingExtraError", "TextColumnsWarning"]


class FormatError(ValueError):
    """A file that cannot be read or written.

    Parameters
    ----------
    file : str
        The file.
    expected : str
        What the format requires.
    got : str
        What was found instead.
    advice : str
        What to do.
    line : int or None
        Line of a text file, counted from 1; None if the error concerns the whole file.
    """

    def __init__(
        self, file: str, expected: str, got: str, advice: str, line: int | None = None
    ) -> None:
        super().__init__(file, expected, got, advice, line)
        self.file = file
        self.expected = expected
        self.got = got
        self.advice = advice
        self.line = line

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}, line {self.line}"
        return f"{place}: expected {self.expected}, got {self.got}; {self.advice}"


class MissingExtraError(FormatError):
    """A format whose library is not installed.

    Parameters
    ----------
    file : str
        The file that was to be read or written.
    package : str
        The library that the format needs.
    extra : str
        The extra of mocapbench that brings it.
    """

    def __init__(self, file: str, package: str, extra: str) -> None:
        advice = f"pip install 'mocapbench[{extra}]'"
        super().__init__(file, f"the package {package}", "none", advice)
        self.args: tuple[str, str, str] = (file, package, extra)
        self.package = package

    def __str__(self) -> str:
        suffix = self.file[self.file.rfind(".") :]
        return f"{self.file}: reading {suffix} needs {self.package}; {self.advice}"


class FormatWarning(UserWarning):
    """A file that is read, and of which something is not as the format or the file itself says."""


class TextColumnsWarning(FormatWarning):
    """Columns of a table are not channels, because they are not numbers."""
