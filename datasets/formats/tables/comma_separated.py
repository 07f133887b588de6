"""Separated values: tables of many programs, of which every cell that is not filled stays."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from mocapbench.datasets.formats.tables.sheet import Sheet, read_sheet
from mocapbench.datasets.formats.tables.table_format import TextTableFormat
from mocapbench.datasets.formats.text.rows import TextTable

__all__ = ["CSVFormat"]


class CSVFormat(TextTableFormat):
    r"""Tables of text (.csv, .tsv, .mot, .sto): a row a frame, a column for each channel.

    Tables of OptiTrack Motive, Vicon Nexus, Qualisys, DeepLabCut, OpenSim and iSen are known by
    their heads. In all others the first line names the columns. ``time`` is in seconds, or in other
    units by name or by its steps, or that of a clock; without it, reading takes a rate. A channel
    may state its unit in brackets, such as ``knee.rx [deg]``, or a known one in parentheses,
    ``knee.rx (deg)``; angles are unwrapped only if it is ``deg`` or ``rad``. Cells that are empty,
    NaN, NA or null are hidden. A count of frames and columns of text are no channels, and are kept
    as they are; a column that is mostly numbers has to be all numbers.

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

    suffixes: ClassVar[tuple[str, ...]] = (".csv", ".tsv", ".mot", ".sto")

    def sheet(self, path: Path) -> Sheet[TextTable]:
        """Return the table of a file, without rows that are missing."""
        return read_sheet(path)
