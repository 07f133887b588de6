"""The frames of an .amc file: the lines of each, and their numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from io import StringIO
from itertools import accumulate, islice

from mocapbench.datasets.acclaim.text import FINITE_NUMBERS, Line, finite_floats

__all__ = ["Frame", "Layout", "frames"]


class Layout:
    """What every frame holds.

    Parameters
    ----------
    counts : sequence of (str, int)
        Segments in the order of the file, each with the number of its degrees of freedom.
    """

    def __init__(self, counts: Sequence[tuple[str, int]]) -> None:
        self.counts = counts
        self._names = [name for name, _ in counts]
        ends = [*accumulate(1 + count for _, count in counts)]
        self._starts = [0, *ends][: len(counts)]
        self.n_words: int = sum(1 + count for _, count in counts)
        self._places = sorted({*range(self.n_words)} - {*self._starts})

    def fits(self, texts: Sequence[str], words: Sequence[str]) -> bool:
        """Return whether each line of a frame begins with its segment and has as many words.

        Parameters
        ----------
        texts, words : sequence of str
            The lines of the frame, its number first; the words of the others.
        """
        if len(words) != self.n_words or not all(map(str.startswith, texts[1:], self._names)):
            return False
        return [words[place] for place in self._starts] == self._names

    def numbers(self, words: Sequence[str]) -> list[str]:
        """Return the words that are not names of segments."""
        return [words[place] for place in self._places]


@dataclass(frozen=True, slots=True)
class Frame:
    """The lines of a frame, its number first; the last frame of a file may lack some.

    Parameters
    ----------
    file : str
        The file, for error messages.
    start : int
        Index of the first line in the file, counted from 0.
    texts : sequence of str
        The lines.
    """

    file: str
    start: int
    texts: Sequence[str]

    def line(self, index: int) -> Line:
        """Return the line at a 0-based index, an empty one after the last."""
        text = self.texts[index] if index < len(self.texts) else ""
        return Line(self.file, self.start + index + 1, text.rstrip())

    def values(self, number: int, layout: Layout) -> list[float]:
        """Return the values of the segments whose lines are there.

        Parameters
        ----------
        number : int
            The number that the frame must have.
        layout : Layout
            The segments that it must have.

        Raises
        ------
        AcclaimError
            If the frame has another number, or a line is not of its segment.
        """
        if self.texts[0].split() != [str(number)]:
            raise self.line(0).error(f"the frame number {number}")
        if len(self.texts) > len(layout.counts):
            words = "".join(self.texts[1:]).split(maxsplit=layout.n_words)
            with suppress(ValueError):
                # All numbers of a frame at once: several times as fast as line by line.
                if layout.fits(self.texts, words):
                    return finite_floats(layout.numbers(words))
        return self._line_by_line(layout.counts)

    def _line_by_line(self, layout: Sequence[tuple[str, int]]) -> list[float]:
        """Return the values of the lines that are there, or name the one that is wrong."""
        shape = layout[: len(self.texts) - 1]
        # No more words than would show that there are too many.
        block = [
            text.split(maxsplit=1 + count)
            for text, (_, count) in zip(self.texts[1:], shape, strict=True)
        ]
        with suppress(ValueError):
            if all(map(_has_shape, block, shape)):
                return finite_floats([word for words in block for word in words[1:]])
        wrong = next(k for k, words in enumerate(block) if not _is_segment(words, shape[k]))
        name, count = shape[wrong]
        raise self.line(1 + wrong).error(f"segment {name!r} with {count} {FINITE_NUMBERS}")


def frames(text: str, file: str, start: int, size: int) -> Iterator[Frame]:
    """Yield the frames of ``size`` lines each, from the line at the 0-based index ``start``."""
    lines = islice(StringIO(text), start, None)
    blocks = iter(lambda: list(islice(lines, size)), [])
    for k, texts in enumerate(blocks):
        yield Frame(file, start + k * size, texts)


def _has_shape(words: Sequence[str], segment: tuple[str, int]) -> bool:
    return words[:1] == [segment[0]] and len(words) == 1 + segment[1]


def _is_segment(words: Sequence[str], segment: tuple[str, int]) -> bool:
    try:
        finite_floats(words[1:])
    except ValueError:
        return False
    return _has_shape(words, segment)
