"""Rows of text as cells, of which some are replaced and the others stay as they are."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

__all__ = ["CellSplitter", "Parts", "Separated", "Words"]

_ENDS = "\r\n"


class CellSplitter(Protocol):
    """How the cells of a row are told apart."""

    @property
    def separator(self) -> str:
        """What is between cells, or the characters that may be; blanks where it is empty."""

    def split(self, line: str) -> list[str]:
        """Return the cells of a line."""

    def replace_cells(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the cells of some indices replaced."""


@dataclass(frozen=True)
class Separated:
    """Cells between separators; those within double quotes belong to the cell.

    Parameters
    ----------
    separator : str
        One character.
    """

    separator: str

    def split(self, line: str) -> list[str]:
        """Return the cells of a line, without quotes and the blanks around."""
        if '"' not in line:
            return line.rstrip(_ENDS).split(self.separator)
        return [cell.strip().strip('"') for cell in self._split_quoted(line)]

    def replace_cells(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the cells of some indices replaced; a short line is lengthened."""
        body = line.rstrip(_ENDS)
        cells = self._split_quoted(body)
        cells += [""] * (1 + max(new) - len(cells))
        for index, cell in new.items():
            cells[index] = cell
        return self.separator.join(cells) + line[len(body) :]

    def _split_quoted(self, line: str) -> list[str]:
        cells: list[str] = []
        for piece in line.rstrip(_ENDS).split(self.separator):
            if cells and cells[-1].count('"') % 2:
                cells[-1] += self.separator + piece
            else:
                cells.append(piece)
        return cells


@dataclass(frozen=True)
class Parts:
    """Cells between any of several separators, which all stay.

    Parameters
    ----------
    separator : str
        Some characters.
    """

    separator: str

    def split(self, line: str) -> list[str]:
        """Return the cells of a line, whichever separators are between them."""
        return re.split(f"[{re.escape(self.separator)}]", line.rstrip(_ENDS))

    def replace_cells(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the cells of some indices replaced."""
        body = line.rstrip(_ENDS)
        pieces = re.split(f"([{re.escape(self.separator)}])", body)  # every other one a separator
        for index, cell in new.items():
            pieces[2 * index] = cell
        return "".join(pieces) + line[len(body) :]


class Words:
    """Cells between blanks."""

    separator = ""

    def split(self, line: str) -> list[str]:
        """Return the words of a line."""
        return line.split()

    def replace_cells(self, line: str, new: Mapping[int, str]) -> str:
        """Return the line with the words of some indices replaced, and all blanks as they were."""
        words = re.findall(r"\s*\S+", line)
        end = line[sum(map(len, words)) :]
        for index, word in new.items():
            words[index] = words[index].removesuffix(words[index].lstrip()) + word
        return "".join(words) + end
