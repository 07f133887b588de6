"""Which recordings are here, in totals, and the command to give next, for ``mocapbench data``."""

from __future__ import annotations

import os
import shlex
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from mocapbench.basics.path_lists import folders_of_recordings
from mocapbench.basics.words import format_count
from mocapbench.datasets import RecordingStatus

__all__ = ["data_totals", "next_data_step"]


def data_totals(rows: Sequence[RecordingStatus], folders: Sequence[Path]) -> str:
    """Return how many recordings are in which state, and how many each named folder has."""
    states = Counter(row.state for row in rows)
    parts = [", ".join(f"{count} {state}" for state, count in states.items())]
    for folder in folders:
        count = sum(folder in Path(row.where).parents for row in rows)
        parts.append(f"{count} in {folder}")
    return f"{format_count(len(rows), 'recording')}: {'; '.join(filter(None, parts))}"


def next_data_step(
    rows: Sequence[RecordingStatus],
    recordings: Sequence[str],
    folders: Sequence[Path],
    plugins: Sequence[Path],
) -> str:
    """Return the command to give next, and why.

    Parameters
    ----------
    rows : sequence of RecordingStatus
    recordings : sequence of str
        Those that the user named, none for all that tasks use.
    folders : sequence of Path
    plugins : sequence of Path
        The options that the user gave, and has to give to the next command too.
    """
    states, options = Counter(row.state for row in rows), [*_list_options(folders, plugins)]
    fetch, verify = (
        shlex.join(["mocapbench", "data", name, *recordings, *options])
        for name in ("fetch", "verify")
    )
    if states["wrong"]:
        return f"next: remove what is wrong, then `{fetch}`"
    if states["missing"]:
        return f"next: `{fetch}` downloads what is missing, or name its folder with --data-dir"
    if states["available"]:
        return f"next: `{verify}` reads them and checks that they are right"
    return f"next: `{shlex.join(['mocapbench', 'run', *options])}`"


def _list_options(folders: Sequence[Path], plugins: Sequence[Path]) -> Iterator[str]:
    if folders and tuple(folders) != folders_of_recordings():
        yield from ("--data-dir", os.pathsep.join(map(str, folders)))
    for path in plugins:
        yield from ("--plugin", str(path))
