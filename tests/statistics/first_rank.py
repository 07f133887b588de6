"""How often the first rank leaves out somebody who is as good: `python first_rank.py [PAGE]`.

A simulated row has k entrants that are equally good over n folds: independent standard normal
losses, so that whoever has the best mean has it by chance. The test is made against that best,
which the same data chose, and so it errs more often than its level says.

Prints the table; puts it into the page as well where one is named.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from mocapbench.metrics.statistics import shared_rank

sys.path.insert(0, str(Path(__file__).parents[1] / "speed"))
from page import place, table

__all__ = ["left_out", "report"]

SEED = 20_240_602
N_ROWS = 1_000
FOLDS = (5, 12)
ENTRANTS = (2, 4, 8, 12)


def left_out(n_folds: int, n_entrants: int) -> tuple[float, float]:
    """Return the share of rows in which somebody is left out, and that of entrants left out."""
    rng = np.random.default_rng([SEED, n_folds, n_entrants])
    missing = []
    for losses in rng.standard_normal((N_ROWS, n_folds, n_entrants)):
        row = pd.DataFrame(losses, columns=[str(entrant) for entrant in range(n_entrants)])
        order = tuple(row.mean().sort_values().index)
        missing.append(n_entrants - len(shared_rank(row, order).labels))
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
