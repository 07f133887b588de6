"""Experiments on how the thesis computed MOA, reported in `docs/results/moa.md`.

The thesis is J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion
Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017.

::

    python docs/evidence/moa.py masks [TEST …]     # one dataset, five masks, as in Tables 1–3
    python docs/evidence/moa.py visible            # 10 and 20 visible points of one dataset
    python docs/evidence/moa.py walking [FOLDS]    # Table 11, each walk mapped by its own range
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.benchmark import METRICS, TASKS, Address, Case, ImputeProblem, Seeds, Task, Unit
from mocapbench.datasets import Recording, open_archive

MODELS = {"pooled": MOA, "independent": LMCIndependent}
SCORES = {"mse": "MSE", "smse_pooled": "SMSE", "msll": "MSLL"}
N_DATASETS, N_MASKS = 3, 5


@dataclass(frozen=True)
class OneDataset(Seeds):
    """Seeds whose folds draw new masks, all of the dataset of fold ``dataset``."""

    dataset: int = 0

    def generator(self, stream: str) -> np.random.Generator:
        """Return the generator of a stream; that of the data is the same in every fold."""
        fold = self.dataset if stream == "data" else self.fold
        return Seeds(self.root, self.address._replace(fold=fold)).generator(stream)


def problem(task: str, case: str, dataset: int, mask: int) -> ImputeProblem:
    """Return the problem of a toy case with a given dataset and mask."""
    known = TASKS.get(task)
    address = Address(known.name, known.version, case, mask)
    return _drawn(known.case(case), OneDataset(0, address, dataset))


def posed(task: Task, case: Case, fold: int, name: str = "") -> ImputeProblem:
    """Return the problem of a case, drawn by the seeds of the case called ``name`` or its own."""
    address = Address(task.name, task.version, name or case.name, fold)
    return _drawn(case, Seeds(0, address))


def _drawn(case: Case, seeds: Seeds) -> ImputeProblem:
    problem = case.problem(seeds, open_archive())
    assert isinstance(problem, ImputeProblem)
    return problem


def scores(problem: ImputeProblem, name: str, **settings: object) -> dict[str, float]:
    """Return the scores of a model on a problem."""
    model = MODELS[name](random_state=0).set_params(**settings)
    outcome = problem.outcome(problem.solve(model.fit(problem.train), 0))
    return {title: METRICS.get(metric)(outcome).value for metric, title in SCORES.items()}


def masks(tests: Sequence[str]) -> pd.DataFrame:
    """Return the error and its 2 sd over the masks of one dataset, averaged over datasets."""
    rows = [
        {"test": f"test {test}", "model": name, "dataset": dataset}
        | scores(
            problem("toy-interpolation-1", f"test {test}", dataset, mask),
            name,
            n_components=3,
            kernel="rbf",
        )
        for test in tests
        for dataset in range(N_DATASETS)
        for mask in range(N_MASKS)
        for name in MODELS
    ]
    of_dataset = pd.DataFrame(rows).groupby(["test", "model", "dataset"])
    mean, two_sd = of_dataset.mean(), 2.0 * of_dataset.std()
    table = mean.assign(**{"2 sd / MSE": two_sd["MSE"] / mean["MSE"]})
    return table.groupby(["test", "model"]).mean()


def visible() -> pd.DataFrame:
    """Return the errors on the data of Tables 7–9 with 10 and with 20 visible points."""
    task = TASKS.get("toy-interpolation-3")
    rows = [
        {"missing in": missing, "visible": n_visible, "model": name}
        | scores(_shown(task.name, missing, n_visible, fold), name, n_components=3, kernel="rbf")
        for missing in ("all", "one")
        for n_visible in (10, 20)
        for fold in range(N_MASKS)
        for name in MODELS
    ]
    return pd.DataFrame(rows).groupby(["missing in", "visible", "model"]).mean()


def _shown(name: str, missing: str, n_visible: int, fold: int) -> ImputeProblem:
    """Return the problem of a case, on the data of the case with 10 visible points."""
    task = TASKS.get(name)
    columns = {"visible": n_visible, "missing in": missing}
    (case,) = (case for case in task.cases if case.columns == columns)
    (ten,) = (case for case in task.cases if case.columns == columns | {"visible": 10})
    return posed(task, case, fold, ten.name)


def walking(n_folds: int) -> pd.DataFrame:
    """Return Table 11 with each walk mapped to [0, 1] by its own range before training."""
    task = TASKS.get("walking-interpolation")
    rows = [
        {
            "visible": case.columns["visible frames"],
            "model": name,
            **scores(_in_own_range(posed(task, case, fold)), name, max_iter=500),
        }
        for case in task.cases
        if not case.synthetic
        for fold in range(n_folds)
        for name in MODELS
    ]
    return pd.DataFrame(rows).groupby(["visible", "model"], sort=False).mean()


def _in_own_range(problem: ImputeProblem) -> ImputeProblem:
    """Return the problem with every recording mapped to [0, 1] by its own complete range."""
    (given,), (truth,) = problem.given, problem.truth
    unit = problem.unit
    first = given.with_values(unit.of(given.values))
    return replace(
        problem,
        train=(first, *map(_normalised, problem.train[1:])),
        given=(first,),
        truth=(unit.of(truth),),
        unit=Unit.natural(truth.shape[1]),
    )


def _normalised(recording: Recording) -> Recording:
    return recording.with_values(Unit.range_of(recording.values).of(recording.values))


def main(arguments: Sequence[str]) -> Iterator[pd.DataFrame]:
    """Yield the requested tables."""
    match list(arguments):
        case ["masks", *tests]:
            yield masks(tests or list("123456789"))
        case ["visible"]:
            yield visible()
        case ["walking", *folds]:
            yield walking(int(folds[0]) if folds else 5)
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    for table in main(sys.argv[1:]):
        print(table.round(3).to_string())
