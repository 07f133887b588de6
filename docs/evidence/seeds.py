"""Runs with other seeds beside an entrant: ``python docs/evidence/seeds.py LABEL RUN…``.

Each run directory holds the same tasks, run with another ``--seed``. For each row, and for all rows
of a task together, it prints the mean and the standard deviation over seeds, and Welch's 95 %
interval of the difference from the entrant LABEL.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.stats import ttest_ind

from mocapbench import benchmark as bench

METRICS = (
    "mlc",
    "mcc",
    "variance_ratio",
    "rms_per_frame",
    "mse",
    "mpjpe",
    "coverage_95",
    "crps",
)
EVERY_CASE = "every case"


def main(reference: str, runs: Sequence[str]) -> None:
    """Print the scores of ``runs``, means over folds first."""
    by_seed: dict[tuple[str, str, str, str], list[float]] = defaultdict(list)
    for store in map(bench.RunDirectory, map(Path, runs)):
        found = defaultdict(list)
        for record in store.planned():
            for metric in set(METRICS) & set(record.scores):
                address = record.address
                for case in (address.case, EVERY_CASE):
                    row = (address.task, case, metric, address.label)
                    found[row].append(record.scores[metric])
        for row, values in found.items():
            by_seed[row].append(float(np.mean(values)))
    for (task, case, metric, label), values in sorted(by_seed.items()):
        spread = f"{np.mean(values):.3f} ± {np.std(values, ddof=1):.3f}"
        line = f"{task} / {case} / {metric}: {label} {spread}"
        beside = by_seed.get((task, case, metric, reference))
        if label != reference and beside:
            interval = ttest_ind(values, beside, equal_var=False).confidence_interval()
            line += f", from {reference} {interval.low:+.3f} to {interval.high:+.3f}"
        print(line)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
