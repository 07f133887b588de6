"""Tables of numbers: what their formats share."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar, Self, TypeVar

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.tables.insertion import lines_with
from mocapbench.datasets.formats.tables.plan import RowTable
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.text.lines import write_lines
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["TableFormat", "TextTableFormat"]

Table = TypeVar("Table", bound=RowTable)


@dataclass(frozen=True)
class TableFormat(Format):
    """Rows with a time and some numbers each.

    Parameters
    ----------
    inserts : bool
        Whether rows that are missing, as times or frames show, are read as hidden frames, and are
        written.
    """

    inserts: bool = False

    memory_per_byte: ClassVar[float] = 12.0

    @abstractmethod
    def sheet(self, path: Path) -> Sheet[RowTable]:
        """Return the table of a file, without rows that are missing."""

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        sheet = self.sheet(path)
        if not self.inserts:
            sheet.warn_of_lacking("--insert-missing inserts them as hidden frames")
        return self.complete(sheet).recording(rate)

    def likelihoods(self, path: Path) -> FrameByChannel | None:
        """Return how likely the file says each entry is, if it has a column for that."""
        sheet = self.complete(self.sheet(path))
        return sheet.likelihoods() if sheet.columns.likelihoods else None

    def with_missing_rows(self) -> Self:
        """Return the format that reads rows that are missing as hidden frames, and adds them."""
        return replace(self, inserts=True)

    def complete(self, sheet: Sheet[Table]) -> Sheet[Table]:
        """Return a sheet with the rows that it lacks, if these are to be added."""
        return sheet.with_lacking() if self.inserts else sheet


class TextTableFormat(TableFormat):
    """Rows of text, of which every cell that is not filled stays."""

    @abstractmethod
    def sheet(self, path: Path) -> Sheet[TextTable]:
        """Return the table of a file, without rows that are missing."""

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new cells."""
        sheet = self.complete(self.sheet(like))
        write_lines(path, lines_with(sheet, values, new), like)
