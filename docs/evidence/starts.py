"""How far below the best of many starts a search of `MOHGP` ends.

It is reported in `docs/results/gaussian-processes.md`.

::

    python docs/evidence/starts.py [STARTS] [FOLDS] [SEED]

prints for tests 1, 2, 4, 5 and 7 of `toy-interpolation-1`, drawn anew in 5 folds, the nats that one
search and that those of the default lose to the best of 21 starts, and processor seconds.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from time import process_time

import pandas as pd

from mocapbench.baselines import MOHGP
from mocapbench.benchmark import Address, Seeds
from mocapbench.benchmark.tasks.toy_interpolation import ONE_INCOMPLETE, toy_problem
from mocapbench.datasets import Recording, open_archive

TESTS = (1, 2, 4, 5, 7)
DEFAULT = MOHGP().n_restarts


def recordings(test: int, fold: int, seed: int) -> tuple[Recording, ...]:
    """Return the training recordings of a test of `toy-interpolation-1`."""
    seeds = Seeds(seed, Address("starts", 1, f"test {test}", fold))
    return tuple(toy_problem(ONE_INCOMPLETE[test - 1], seeds, open_archive()).train)


def losses(n_starts: int, n_folds: int, seed: int) -> Iterator[dict[str, float]]:
    """Yield nats lost and seconds for each set of recordings."""
    for fold in range(n_folds):
        for test in TESTS:
            train, begun = recordings(test, fold, seed), process_time()
            model = MOHGP(n_components=3, kernel="rbf", n_restarts=n_starts, random_state=0)
            searches = model.fit(train).training_
            reached = [search.log_likelihood for search in searches]
            seconds = process_time() - begun
            work = [search.n_evaluations for search in searches]
            yield {
                "test": test,
                "fold": fold,
                "one search": max(reached) - reached[0],
                "default": max(reached) - max(reached[:DEFAULT]),
                "seconds, one": seconds * work[0] / sum(work),
                "seconds, default": seconds * sum(work[:DEFAULT]) / sum(work),
                "seconds, all": seconds,
            }


def main(n_starts: str = "21", n_folds: str = "5", seed: str = "1") -> None:
    """Print the table, and how many lose more than one nat."""
    table = pd.DataFrame(losses(int(n_starts), int(n_folds), int(seed)))
    print(table.round(2).to_string(index=False))
    lost = table[["one search", "default"]]
    print(f"more than 1 nat lost, of {len(table)}:", (lost > 1.0).sum().to_dict())
    print("most lost:", lost.max().round(1).to_dict())


if __name__ == "__main__":
    main(*sys.argv[1:])
