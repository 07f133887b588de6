"""What registration in time does for `walking-interpolation`.

It is reported in `docs/results/gaussian-processes.md`.

::

    python docs/evidence/registration.py [REGISTRATION] [MAX_ITER] [FOLDS] [ENTRANT]

prints the scores of an entrant of the task (by default `mohgp-1+5`) with the registration
(`affine`, `none`) for every fold and number of visible frames. Recordings are read from the folder
in the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from time import process_time

from mocapbench.baselines import MOHGP
from mocapbench.benchmark import METRICS, Address, Seeds
from mocapbench.benchmark.tasks.walking_interpolation import (
    WALKERS,
    walking_interpolation,
    walking_problem,
)
from mocapbench.datasets import Archive, open_archive


def row(archive: Archive, visible: int, fold: int, model: MOHGP) -> str:
    """Return SMSE, pooled SMSE, MSLL and processor seconds of a fit."""
    seeds = Seeds(0, Address("walking-interpolation", 1, f"observed {visible}", fold))
    problem = walking_problem(WALKERS, visible, seeds, archive)
    begun = process_time()
    outcome = problem.outcome(problem.solve(model.fit(problem.train), 0))
    seconds = process_time() - begun
    smse, pooled, msll = (METRICS.get(n)(outcome).value for n in ("smse", "smse_pooled", "msll"))
    return f"{visible} {fold} SMSE {smse:.4f} pooled {pooled:.4f} MSLL {msll:.3f} {seconds:.0f} s"


def main(
    registration: str = "affine",
    max_iter: str = "80",
    folds: str = "5",
    entrant: str = "mohgp-1+5",
) -> None:
    """Print a line for each fit."""
    archive = open_archive(Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0]))
    (parameters,) = (e.parameters for e in walking_interpolation.entrants if e.label == entrant)
    model = MOHGP().set_params(**parameters)
    model.set_params(registration=registration, max_iter=int(max_iter))
    for fold in range(int(folds)):
        for visible in (40, 30, 20, 10):
            print(row(archive, visible, fold, model), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
