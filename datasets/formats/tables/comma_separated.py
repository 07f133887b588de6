"""Separated values: tables of many programs, of which every cell that is not filled stays."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.tables.insertion import lines_with
from mocapbench.datasets.formats.tables.sheet import Sheet, read_sheet
from mocapbench.datasets.formats.text.lines import write_lines
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["CSVFormat"]


@dataclass(frozen=True)
class CSVFormat(Format):
    r"""Tables of text (.csv, .tsv, .mot, .sto): a row a frame, a column for each channel.

    Tables of OptiTrack Motive, Vicon Nexus, Qualisys, DeepLabCut and OpenSim are known by their
    heads. In all others the first line names the columns. ``time`` is in seconds, or in other units
    by name or by its steps; without it, reading takes a rate. A channel may state its unit in
    brackets, such as ``knee.rx [deg]``, or a known one in parentheses, ``knee.rx (deg)``; angles
    are unwrapped only if it is ``deg`` or ``rad``. Cells that are empty, NaN, NA or null are
    hidden. A count of frames and columns of text are no channels, and are kept as they are; a
    column that is mostly numbers has to be all numbers.

    Semicolons or tabs may stand between columns. Numbers may then have decimal commas, and are
    written as they were read. Where several rows have one frame, a column of text tells of which
    marker each is.

    Parameters
    ----------
    inserts : bool
        Whether rows that are missing, as times or frames show, are read as hidden frames, and are
        written.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import CSVFormat
    >>> with TemporaryDirectory() as folder:
    ...     given, out = Path(folder, "walk.csv"), Path(folder, "filled.csv")
    ...     _ = given.write_text("time;knee [deg]\n0;1,50\n0,1;\n0,2;2,50\n")
    ...     walk = CSVFormat().read(given)
    ...     CSVFormat().write(out, walk.with_values([[1.5], [2.0], [2.5]]), like=given)
    ...     out.read_text().splitlines()
    ['time;knee [deg]', '0;1,50', '0,1;2,0', '0,2;2,50']
    """

    inserts: bool = False

    suffixes = (".csv", ".tsv", ".mot", ".sto")
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        sheet = read_sheet(path)
        if not self.inserts:
            sheet.warn_of_lacking("; --insert-missing inserts them as hidden frames")
        return self._completed(sheet).recording(rate)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new cells."""
        sheet = self._completed(read_sheet(like))
        write_lines(path, lines_with(sheet, values, new), like)

    def likelihoods(self, path: Path) -> FrameByChannel | None:
        """Return how likely the file says each entry is, if it has a column for that."""
        sheet = self._completed(read_sheet(path))
        return sheet.likelihoods() if sheet.columns.likelihoods else None

    def with_missing_rows(self) -> CSVFormat:
        """Return the format that reads rows that are missing as hidden frames, and adds them."""
        return replace(self, inserts=True)

    def _completed(self, sheet: Sheet) -> Sheet:
        return sheet.with_lacking() if self.inserts else sheet
