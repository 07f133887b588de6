"""Lengths and numbers of gaps that overlap in real files, as `datasets/occlusion` has them.

::

    python docs/evidence/occlusion.py FILE [FILE]...

prints the table. Gaps that begin or end with the recording, results of a model of the body, and
markers that nobody named are left out.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.formats import read_measured
from mocapbench.datasets import Mask


def hidden_markers(path: Path) -> tuple[float, Mask]:
    """Return frames per second, and where a coordinate of each marker (N, M) is hidden."""
    recording = read_measured(path)
    columns: dict[str, list[int]] = {}
    for column, channel in enumerate(recording.channels):
        columns.setdefault(channel.rpartition(".")[0], []).append(column)
    hidden = [~recording.visible[:, own].all(axis=1) for own in columns.values()]
    return 1.0 / float(np.diff(recording.times).mean()), np.stack(hidden, axis=1)


def group_gaps(hidden: Mask) -> Iterator[list[int]]:
    """Yield the lengths of gaps of which each overlaps with another, the longest first."""
    bounds = [gap for column in hidden.T for gap in run_bounds(column).tolist()]
    inner = sorted(gap for gap in bounds if gap[0] > 0 and gap[1] < len(hidden))
    lengths: list[int] = []
    end = 0
    for start, stop in inner:
        if lengths and start >= end:
            yield sorted(lengths, reverse=True)
            lengths = []
        lengths.append(stop - start)
        end = max(end, stop)
    if lengths:
        yield sorted(lengths, reverse=True)


def main(paths: Sequence[str]) -> None:
    """Print the table."""
    print("file,rate,frames,markers,gaps")
    for path in map(Path, paths):
        rate, hidden = hidden_markers(path)
        for lengths in group_gaps(hidden):
            gaps = " ".join(map(str, lengths))
            print(f"{path.name},{rate:.0f},{len(hidden)},{hidden.shape[1]},{gaps}")


if __name__ == "__main__":
    main(sys.argv[1:])
