"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import typer

__all__ = ["Names", "split"]

Names = Annotated[list[str] | None, typer.Option(help="Names, repeated or separated by commas.")]


def split(names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of an option, however they were separated."""
    parts = (part.strip() for name in names or () for part in name.split(","))
    return tuple(part for part in parts if part)
