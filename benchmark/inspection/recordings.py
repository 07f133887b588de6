"""Which recordings are here, in totals, and the command to give next, for ``mocapbench data``."""

from __future__ import annotations

import os
import shlex
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from mocapbench.basics.words import format_count
from mocapbench.datasets import RecordingStatus, named_folders

__all__ = ["DataRequest", "data_totals", "next_data_step"]


class DataRequest(NamedTuple):
    """What the user gave to ``mocapbench data``, and has to give to the next command too."""

    trials: Sequence[str] | None
    data_dir: Path | None
    plugins: Sequence[Path] | None

    def command(self, *words: str) -> str:
        """Return a command that has the same folder and plug-ins."""
        return shlex.join(["mocapbench", *words, *self._options()])

    def data_command(self, name: str) -> str:
        """Return a command of ``mocapbench data`` on the same recordings."""
        return self.command("data", name, *(self.trials or ()))

    def _options(self) -> Iterator[str]:
        if self.data_dir and str(self.data_dir) != os.environ.get("MOCAPBENCH_DATA"):
            yield from ("--data-dir", str(self.data_dir))
        for path in self.plugins or ():
            yield from ("--plugin", str(path))


def data_totals(rows: Sequence[RecordingStatus], data_dir: Path | None) -> str:
    """Return how many recordings are in which state, and how many each named folder has."""
    states = Counter(row.state for row in rows)
    parts = [", ".join(f"{count} {state}" for state, count in states.items())]
    for folder in named_folders(data_dir):
        count = sum(folder in Path(row.where).parents for row in rows)
        parts.append(f"{count} in {folder}")
    return f"{format_count(len(rows), 'recording')}: {'; '.join(filter(None, parts))}"


def next_data_step(rows: Sequence[RecordingStatus], request: DataRequest) -> str:
    """Return the command to give next, and why."""
    states = Counter(row.state for row in rows)
    fetch, verify = request.data_command("fetch"), request.data_command("verify")
    if states["wrong"]:
        return f"next: remove what is wrong, then `{fetch}`"
    if states["missing"]:
        return f"next: `{fetch}` downloads what is missing, or name its folder with --data-dir"
    if states["available"]:
        return f"next: `{verify}` reads them and checks that they are right"
    return f"next: `{request.command('run')}`"
