"""Tables of text: what their formats share."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.tables.insertion import lines_with
from mocapbench.datasets.formats.tables.sheet import Sheet
from mocapbench.datasets.formats.text.lines import write_lines
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["TableFormat"]


@dataclass(frozen=True)
class TableFormat(Format):
    """Rows of text with a time and some numbers each, of which every cell not filled stays.

    Parameters
    ----------
    inserts : bool
        Whether rows that are missing, as times or frames show, are read as hidden frames, and are
        written.
    """

    inserts: bool = False

    memory_per_byte = 12.0

    @abstractmethod
    def sheet(self, path: Path) -> Sheet:
        """Return the table of a file, without rows that are missing."""

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        sheet = self.sheet(path)
        if not self.inserts:
            sheet.warn_of_lacking("--insert-missing inserts them as hidden frames")
        return self._completed(sheet).recording(rate)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new cells."""
        sheet = self._completed(self.sheet(like))
        write_lines(path, lines_with(sheet, values, new), like)

    def likelihoods(self, path: Path) -> FrameByChannel | None:
        """Return how likely the file says each entry is, if it has a column for that."""
        sheet = self._completed(self.sheet(path))
        return sheet.likelihoods() if sheet.columns.likelihoods else None

    def with_missing_rows(self) -> Self:
        """Return the format that reads rows that are missing as hidden frames, and adds them."""
        return replace(self, inserts=True)

    def _completed(self, sheet: Sheet) -> Sheet:
        return sheet.with_lacking() if self.inserts else sheet
