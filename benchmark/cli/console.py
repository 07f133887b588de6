"""The console of every command, which shows text as it is and as nothing but text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.text import Text

from mocapbench.basics.words import printable

__all__ = ["LiteralConsole"]


class LiteralConsole(Console):
    """A console for names and messages of others.

    Brackets are not markup, colons are not emoji, and what a terminal would obey is left out:
    escape sequences, control characters, marks of direction, and links.

    Parameters
    ----------
    stderr : bool
        Whether it writes to standard error.
    """

    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, markup=False, emoji=False)

    def render_str(self, text: str, **options: Any) -> Text:
        """Return ``text`` as rich lays it out, so that no room is kept for what is left out."""
        return super().render_str(printable(text), **options)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterator[Segment]:
        """Yield the pieces of ``renderable``; all that is written passes here, however made."""
        for text, style, control in Segment.strip_links(super().render(renderable, options)):
            yield Segment(text if control else printable(text), style, control)
