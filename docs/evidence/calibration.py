"""Coverage, MSLL, CRPS and errors that `docs/results/calibration.md` reports.

::

    python docs/evidence/calibration.py walkers   # training walkers, each left out in turn
    python docs/evidence/calibration.py new       # walkers and other motions of no task's choice
    python docs/evidence/calibration.py left-out  # Gaussian processes before and after calibration
    python docs/evidence/calibration.py gaps      # the same processes in gaps of a limb

All but the last two learn from the three training walkers of `missing-frames`. Its own test
recordings are not used here: `mocapbench run` scores them. The last two have another root seed than
the benchmark, which hides other entries.
"""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import product

import numpy as np

from mocapbench import benchmark as bench
from mocapbench.baselines import (
    FAM,
    GPDM,
    GPLVM,
    HGP,
    LDS,
    MOA,
    MOHGP,
    Calibrated,
    CyclicAlignment,
    FrameImputer,
    GPIndependent,
    LMCIndependent,
    PoseKriging,
)
from mocapbench.benchmark import ImputeProblem
from mocapbench.benchmark.tasks.missing_frames import (
    FIRST_HIDDEN,
    GROUPS,
    N_HIDDEN,
    N_TEST_FRAMES,
    N_WINDOWS,
    TRAINING,
)
from mocapbench.datasets import Recording, gpdm_features, one_based_frames
from mocapbench.metrics import coverage_95, crps, msll, rms_per_frame

MODELS: Mapping[str, Callable[[], FrameImputer]] = {
    "pose-kriging": PoseKriging,
    "lds": lambda: Calibrated(LDS()),
    "fam": lambda: Calibrated(FAM(random_state=0)),
    "gpdm balanced": lambda: Calibrated(GPDM(max_iter=10, fill_iter=20, random_state=0)),
    "gpdm map": lambda: Calibrated(GPDM("map", max_iter=10, fill_iter=20, random_state=0)),
    "gpdm balanced, six dimensions": lambda: Calibrated(
        GPDM(
            n_latent=6,
            start="viterbi",
            subject_offset=1.0,
            max_iter=10,
            fill_iter=20,
            random_state=0,
        )
    ),
    "gplvm": lambda: Calibrated(GPLVM(start="window", max_iter=10, fill_iter=20, random_state=0)),
    "cyclic-alignment": lambda: Calibrated(CyclicAlignment(random_state=0)),
}
PROCESSES: Mapping[str, Callable[[], FrameImputer]] = {
    "mohgp-3": lambda: MOHGP(n_components=3, n_restarts=1, max_iter=60),
    "moa-3": lambda: MOA(n_components=3, max_iter=60),
    "lmc-independent-3": lambda: LMCIndependent(n_components=3, max_iter=60),
    "hgp": lambda: HGP(max_iter=60),
    "gp-independent": lambda: GPIndependent(max_iter=60),
    "mohgp-1": lambda: MOHGP(n_restarts=1, max_iter=60),
    "moa-1": lambda: MOA(max_iter=60),
    "lmc-independent-1": lambda: LMCIndependent(max_iter=60),
}
LEFT_OUT: Mapping[str, tuple[str, int]] = {
    "toy-interpolation-1": ("test", 3),
    "toy-interpolation-2": ("test", 3),
    "toy-interpolation-3": ("test", 3),
    "walking-interpolation": ("observed", 1),
}
"""By task, what its cases are named, and folds."""
GAPS: Mapping[str, tuple[str, int]] = {"marker-gaps": ("a limb", 4)}
"""By task, what its cases are named, and folds: trained on others and on the recording alone."""
GAP_FILLING: Mapping[str, Callable[[], FrameImputer]] = {
    "mohgp-1": lambda: MOHGP(n_restarts=1, max_iter=10),
    "moa-1": lambda: MOA(max_iter=10),
    "lmc-independent-1": lambda: LMCIndependent(max_iter=10),
    "hgp": lambda: HGP(max_iter=10),
    "gp-independent": lambda: GPIndependent(max_iter=10),
}
OTHER_SEED = 7
WALKS = "02_01 02_02 39_01 39_02 07_03 07_04 08_04 16_22 16_31 16_32 07_06 08_03 08_06 16_16"


def training() -> list[Recording]:
    """Return the training walkers that are at hand."""
    archive = bench.archive_at()
    return [
        gpdm_features(one_based_frames(archive.recording(uri), *TRAINING[uri]))
        for uri in GROUPS["three-walkers"]
    ]


def windows(test: Recording, train: Sequence[Recording], step: int = 1) -> Iterator[ImputeProblem]:
    """Yield the task's windows over the first frames of a recording."""
    short = test.frames(np.arange(N_TEST_FRAMES))
    for first in range(FIRST_HIDDEN, FIRST_HIDDEN + N_WINDOWS, step):
        mask = np.zeros(short.values.shape, dtype=bool)
        mask[first : first + N_HIDDEN] = True
        yield ImputeProblem.of_one(short, mask, train, seen_in_fit=False)


def report(name: str, model: FrameImputer, problems: Sequence[ImputeProblem]) -> None:
    """Print mean error, coverage, MSLL and CRPS of a fitted model."""
    began, rows = time.process_time(), []
    for problem in problems:
        outcome = problem.outcome(tuple(model.impute(problem.given)))
        metrics = (rms_per_frame, coverage_95, msll, crps)
        rows.append([m(outcome).value if m.applies(outcome) else np.nan for m in metrics])
    error, coverage, loss, score = np.mean(rows, axis=0)
    seconds = (time.process_time() - began) / len(problems)
    print(f"{name:32} {error:7.2f} {coverage:6.3f} {loss:8.2f} {score:6.2f} {seconds:6.2f} s")


def walkers() -> None:
    """Print the scores of each training walker when it is left out."""
    walks = training()
    for name, make in MODELS.items():
        for test in walks:
            train = [walk for walk in walks if walk is not test]
            model = make().fit(train)
            report(f"{name} {test.name}", model, list(windows(test, train, 4)))


def new_walkers() -> None:
    """Print the scores of walks and other motions that take part in no task as tests."""
    train, archive = training(), bench.archive_at()
    for name, make in MODELS.items():
        model = make().fit(train)
        for trial in WALKS.split():
            test = gpdm_features(archive.recording(f"cmu:{trial}"))
            report(f"{name} {trial}", model, list(windows(test, train, 4)))


def pose_problems(task: str, named: str, n_folds: int) -> Iterator[ImputeProblem]:
    """Yield problems of a task with another root seed than the benchmark."""
    archive = bench.archive_at()
    for case in bench.TASKS.get(task).cases:
        if named in case.name and not case.synthetic:
            for fold in range(n_folds):
                address = bench.Address(task, 1, case.name, fold)
                problem = case.problem(bench.Seeds(OTHER_SEED, address), archive)
                assert isinstance(problem, ImputeProblem)
                yield problem


def compare_models(
    tasks: Mapping[str, tuple[str, int]], models: Mapping[str, Callable[[], FrameImputer]]
) -> None:
    """Print coverage, MSLL and CRPS before and after calibration, and how many problems."""
    for (task, (named, n_folds)), (name, make) in product(tasks.items(), models.items()):
        rows: list[list[float]] = []
        for problem in pose_problems(task, named, n_folds):
            with suppress(ValueError):
                rows.append(compare_variances(Calibrated(make()).fit(problem.train), problem))
        means = np.mean(rows, axis=0).round(3)
        print(f"{task:22} {name:16}", *means, f"{len(rows)} problems", flush=True)


def compare_variances(model: Calibrated, problem: ImputeProblem) -> list[float]:
    """Return the coverage, MSLL and CRPS of the uncalibrated and of the calibrated variances."""
    answers = (model.model_.impute(problem.given), model.impute(problem.given))
    outcomes = [problem.outcome(tuple(answer)) for answer in answers]
    return [m(outcome).value for m in (coverage_95, msll, crps) for outcome in outcomes]


COMMANDS: Mapping[str, Callable[[], None]] = {
    "walkers": walkers,
    "new": new_walkers,
    "left-out": partial(compare_models, LEFT_OUT, PROCESSES),
    "gaps": partial(compare_models, GAPS, GAP_FILLING),
}

if __name__ == "__main__":
    warnings.simplefilter("ignore")
    COMMANDS[sys.argv[1]]()
