"""Which recordings are here, in totals, and the command to give next, for ``mocapbench data``."""

from __future__ import annotations

import os
import shlex
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from mocapbench.basics.path_lists import folders_of_recordings
from mocapbench.basics.words import format_count
from mocapbench.benchmark.archives import explain_fetching, recording_names
from mocapbench.datasets import Archive, RecordingStatus

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
    archive: Archive,
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
    archive : Archive
        Which knows what cannot be downloaded.
    """
    states, options = Counter(row.state for row in rows), [*_list_options(folders, plugins)]
    lost = [row.uri for row in rows if row.state in {"missing", "wrong"}]

    def name_command(name: str, uris: Sequence[str]) -> str:
        names = recordings if len(uris) == len(lost) else recording_names(uris)
        return f"`{shlex.join(['mocapbench', 'data', name, *names, *options])}`"

    def name_fetching(uris: Sequence[str], those: str) -> str:
        what = "what is missing" if len(uris) == len(lost) else those
        return f"{name_command('fetch', uris)} downloads {what}, or name its folder with --data-dir"

    if states["wrong"]:
        remedy = explain_fetching(lost, archive, lambda uris, _: name_command("fetch", uris))
        return f"next: remove what is wrong, then {remedy}"
    if states["missing"]:
        return f"next: {explain_fetching(lost, archive, name_fetching)}"
    if states["available"]:
        return f"next: {name_command('verify', lost)} reads them and checks that they are right"
    return f"next: `{shlex.join(['mocapbench', 'run', *options])}`"


def _list_options(folders: Sequence[Path], plugins: Sequence[Path]) -> Iterator[str]:
    if folders and tuple(folders) != folders_of_recordings():
        yield from ("--data-dir", os.pathsep.join(map(str, folders)))
    for path in plugins:
        yield from ("--plugin", str(path))
