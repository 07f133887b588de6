"""How `best-of` weighs its candidates, tried where training recordings take the place of tests.

It is reported in `docs/calibration.md`.

::

    python docs/evidence/stacking.py [HELD_OUT]

prints the error of the mean with each shrinkage, relative to the best candidate of the task, for
the channels of each unit. Of each case, so many training recordings are held out in turn and have
the gaps of the test.
Recordings are read from the folders in the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench import benchmark as bench
from mocapbench.baselines import BestOf
from mocapbench.baselines.choosing.parts import parts_of
from mocapbench.baselines.choosing.rehearsals import Rehearsals
from mocapbench.baselines.choosing.weights import among, evidence, weights_of
from mocapbench.baselines.rehearsal.stand_ins import aligned
from mocapbench.datasets import Recording

TASKS = ("subject-35-missing", "upper-body-missing", "missing-frames", "golf-swings")
SHRINKAGES = (0.0, 0.25, 0.4, 0.5, 0.6, 0.75, 1.0)


def turns(task: str, n_held_out: int) -> Iterator[tuple[list[Recording], Recording, Recording]]:
    """Yield what is left to learn from, a recording held out with the gaps of a test, and whole."""
    archive = bench.archive_at(None)
    request = bench.Request(profile="paper", tasks=(task,), models=("best-of",), folds=1)
    for job in bench.plan(request, archive):
        if job.missing or "synthetic" in job.address.case:
            continue
        problem = bench.TASKS.get(task).case(job.address.case).problem(job.seeds, archive)
        assert isinstance(problem, bench.ImputeProblem)
        given = problem.given[0]
        train = [recording for recording in problem.train if recording.name != given.name]
        for k in sorted({int((i + 0.5) * len(train) / n_held_out) for i in range(n_held_out)}):
            ((whole, gaps),) = aligned(train[k], [~given.visible])
            yield train[:k] + train[k + 1 :], whole.hide(gaps), whole


def errors(train: list[Recording], given: Recording, whole: Recording) -> Iterator[pd.Series]:
    """Yield for each part the root mean squared errors of candidates, and of means by shrinkage.

    A part is the channels of a unit, as no test has gaps in all channels beside others.
    """
    model = BestOf().fit(train)
    means = model.panel_.means(given)
    rehearsals = Rehearsals(model.recordings_, model.panel_, given)
    hidden = ~given.visible
    for name, part in parts_of(given).items():
        entries = part.entries(hidden) & hidden
        if not entries.any():
            continue
        sources = among(evidence(rehearsals, part), means)
        for shrinkage in SHRINKAGES:
            weights = weights_of(sources, shrinkage)
            means[f"{shrinkage:g}"] = np.sum([w * means[n] for n, w in weights.items()], axis=0)
        off = {n: (m - whole.values)[entries] for n, m in means.items()}
        yield pd.Series({n: np.sqrt(np.mean(e**2)) for n, e in off.items()}, name=name)


def main(n_held_out: str = "3") -> None:
    """Print a line for each task and unit."""
    for task in TASKS:
        rows = pd.DataFrame([row for turn in turns(task, int(n_held_out)) for row in errors(*turn)])
        for unit, of_unit in rows.groupby(level=0):
            table = of_unit.dropna(axis=1).mean()
            shown = [f"{shrinkage:g}" for shrinkage in SHRINKAGES]
            best = str(table.drop(shown).idxmin())
            ratios = (table[shown] / table[best]).round(3).to_dict()
            print(f"{task} {unit or 'place'} {len(of_unit)} best: {best} {ratios}")


if __name__ == "__main__":
    main(*sys.argv[1:])
