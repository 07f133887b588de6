"""Write `benchmark/inspection/typical_seconds.csv` from run directories of smoke and quick.

``python docs/evidence/typical_seconds.py RUN...`` prints the table: of each profile, task and
entrant the mean seconds of a fit, predictions included. `mocapbench run --dry-run` estimates by it
where the run directory has no records of the entrant.
"""

from __future__ import annotations

import csv
import sys
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from statistics import fmean

from mocapbench import benchmark as bench


def main(runs: Sequence[str]) -> None:
    """Print the table of the run directories ``runs``."""
    seconds: dict[tuple[str, str, str], list[float]] = defaultdict(list)
    for store in map(bench.RunDirectory, map(Path, runs)):
        profile = store.load_plan()["provenance"]["profile"]
        for record in store.planned():
            if record.seconds is not None:
                row = profile, record.address.task, record.address.label
                seconds[row].append(record.seconds)
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(("profile", "task", "label", "seconds"))
    rows.writerows((*row, f"{fmean(values):.2g}") for row, values in sorted(seconds.items()))


if __name__ == "__main__":
    main(sys.argv[1:])
