"""The first page of a leaderboard: one HTML file that needs no network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mocapbench.reports.resources import fill_template, styles
from mocapbench.reports.tables.base import Table

__all__ = ["render_leaderboard"]


def render_leaderboard(
    entrants: Sequence[Mapping[str, Any]], tables: Sequence[Table], archives: Sequence[str]
) -> str:
    """Return who takes part, and the means of each task with intervals, as one HTML page.

    Parameters
    ----------
    entrants : sequence of mapping
        Of each its ``label``, ``by``, ``link``, ``paper``, ``code``, ``licence``, ``hardware``,
        ``profile``, ``tasks``, ``jobs`` and ``lacking``.
    tables : sequence of Table
        One a task.
    archives : sequence of str
        Names of the files that it was made of.
    """
    return fill_template(
        "parts/leaderboard.html.j2",
        entrants=entrants,
        tables=tables,
        archives=archives,
        css=styles(),
    )
