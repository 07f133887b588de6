"""How often an equally good entrant misses the first rank: `python first_rank.py [PAGE]`.

A simulated row has k equally good entrants over n folds: their losses are independent standard
normal, so that the best mean is best by chance. The tests compare with that best, which was chosen
on the same data, and so their error rate is above their level.

Prints the table, and writes it into the page if one is given.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from mocapbench.metrics.statistics import holm_tests

sys.path.insert(0, str(Path(__file__).parents[1] / "speed"))
from page import place, table

__all__ = ["left_out", "report"]

SEED = 20_240_602
N_ROWS = 1_000
FOLDS = (5, 12)
ENTRANTS = (2, 4, 8, 12)


def left_out(n_folds: int, n_entrants: int) -> tuple[float, float]:
    """Return the share of rows in which an entrant is left out, and the share of such entrants."""
    rng = np.random.default_rng([SEED, n_folds, n_entrants])
    missing = []
    for losses in rng.standard_normal((N_ROWS, n_folds, n_entrants)):
        best, *others = np.argsort(losses.mean(axis=0))
        differences = (losses[:, others] - losses[:, [best]]).T
        missing.append(int(holm_tests(differences).separable.sum()))
    return float(np.mean(np.array(missing) > 0)), float(np.mean(missing)) / (n_entrants - 1)


def _rows() -> Iterator[list[str]]:
    for n_entrants in ENTRANTS:
        for n_folds in FOLDS:
            shares = left_out(n_folds, n_entrants)
            yield [str(n_entrants), str(n_folds), *(f"{100.0 * share:.1f} %" for share in shares)]


def report() -> str:
    """Return the table."""
    head = ["entrants", "folds", "rows that leave somebody out", "of the others, left out"]
    return table(head, _rows())


if __name__ == "__main__":
    text = report()
    print(text)
    for page in sys.argv[1:]:
        place(Path(page), "first-rank", text)
