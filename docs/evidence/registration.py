"""What registration in time does for `walking-interpolation`.

It is reported in `docs/frontier/gaussian-processes.md`.

::

    python docs/evidence/registration.py [REGISTRATION] [MAX_ITER] [FOLDS] [VISIBLE ...]

prints the scores of `mohgp-1+5` with the registration (`affine`, `none`) for every fold and number
of visible frames. Recordings are read from the folder in the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from time import process_time

from mocapbench.baselines import MOHGP
from mocapbench.benchmark import METRICS, Address, Seeds
from mocapbench.benchmark.tasks.walking_interpolation import WALKERS, walking_problem
from mocapbench.datasets import Archive, open_archive


def row(archive: Archive, visible: int, fold: int, registration: str, max_iter: int) -> str:
    """Return pooled SMSE, MSLL and processor seconds of a fit."""
    seeds = Seeds(0, Address("walking-interpolation", 1, f"observed {visible}", fold))
    problem = walking_problem(WALKERS, visible, seeds, archive)
    begun = process_time()
    model = MOHGP(
        n_components={"parent": 1, "child": 5},
        registration=registration,
        n_restarts=1,
        max_iter=max_iter,
    ).fit(problem.train)
    outcome = problem.outcome(problem.solve(model, 0))
    seconds = process_time() - begun
    smse, msll = (METRICS.get(name)(outcome).value for name in ("smse_pooled", "msll"))
    return f"{visible} {fold} {registration} SMSE {smse:.4f} MSLL {msll:.3f} {seconds:.0f} s"


def main(
    registration: str = "affine", max_iter: str = "80", folds: str = "5", *visible: str
) -> None:
    """Print a line for each fit."""
    archive = open_archive(Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0]))
    for fold in range(int(folds)):
        for frames in map(int, visible or ("40", "30", "20", "10")):
            print(row(archive, frames, fold, registration, int(max_iter)), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
