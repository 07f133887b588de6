"""Channels that are hidden throughout a recording, which `docs/results/calibration.md` reports.

::

    python docs/evidence/lost_channels.py [checked]

prints, for each model, coverage of 95 %, MSLL and CRPS before and after calibration; then the error
of `best-of` beside the best of its candidates and beside the mean of a channel. Joint angles are
hidden throughout in three recordings of each group, filled after training on the others. With
`checked` the groups are those on which nothing was chosen. Recordings are read from the folders in
the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product

import numpy as np

from mocapbench import benchmark as bench
from mocapbench.baselines import FAM, LDS, BestOf, Calibrated, ChannelKriging, FrameImputer, LowRank
from mocapbench.benchmark import ImputeProblem
from mocapbench.datasets import FrameByChannel, Recording
from mocapbench.metrics import coverage_95, crps, msll

MODELS: Mapping[str, Callable[[], FrameImputer]] = {
    "lds": LDS,
    "fam": lambda: FAM(n_restarts=1, max_iter=10, random_state=0),
    "low-rank": LowRank,
    "channel-kriging": ChannelKriging,
}
CHOSEN_ON = (
    "35_01 35_02 35_03 35_04 35_05 35_06",
    "07_01 07_02 07_03 07_06 07_07",
    "02_01 07_01 08_01 16_22 39_01",
    "64_05 64_10 64_16 64_20 64_03",
)
CHECKED_ON = (
    "02_01 02_02 02_03 02_04 02_05",
    "16_01 16_03 16_08 16_11 16_17 16_22",
    "10_01 10_02 10_03 11_01 09_01",
    "16_31 39_02 08_04 35_10 07_04 02_02",
)
BONES = (
    {"lfemur", "ltibia", "lfoot", "ltoes"},
    {"rclavicle", "rhumerus", "rradius", "rwrist"},
    {"rtibia"},
    {"head", "upperneck", "lowerneck"},
)
MOST_FRAMES, STEP = 480, 4
"""Every fourth of the first frames, at 120 a second."""


def recordings(trials: str) -> list[Recording]:
    """Return the joint angles that move in all of these recordings."""
    archive = bench.archive_at()
    whole = [archive.recording(f"cmu:{trial}") for trial in trials.split()]
    cut = [one.frames(np.arange(0, min(len(one.times), MOST_FRAMES), STEP)) for one in whole]
    moving = np.min([np.std(one.values, axis=0) for one in cut], axis=0) > 1e-3
    names = [name for name, moves in zip(cut[0].channels, moving, strict=True) if moves]
    return [one.select([name for name in names if not name.startswith("root")]) for one in cut]


def problems(groups: Sequence[str]) -> Iterator[ImputeProblem]:
    """Yield three recordings of each group, learnt from the others, with each set of bones."""
    for group, bones in product(groups, BONES):
        every = recordings(group)
        lost = np.array([name.split(".")[0] in bones for name in every[0].channels])
        for truth in every[:3]:
            mask = np.broadcast_to(lost, truth.values.shape)
            train = [other for other in every if other is not truth]
            yield ImputeProblem.of_one(truth, mask, train, seen_in_fit=False)


def compare_variances(model: Calibrated, problem: ImputeProblem) -> list[float]:
    """Return coverage, MSLL and CRPS of the uncalibrated and of the calibrated variances."""
    answers = (model.model_.impute(problem.given), model.impute(problem.given))
    outcomes = [problem.outcome(tuple(answer)) for answer in answers]
    return [m(outcome).value for m in (coverage_95, msll, crps) for outcome in outcomes]


def ratios(problem: ImputeProblem) -> tuple[float, float]:
    """Return the error of `best-of` beside that of its best candidate, and of a channel's mean."""
    model = BestOf().fit(problem.train)

    def error(mean: FrameByChannel) -> float:
        off = (mean - problem.truth[0])[~problem.given[0].visible]
        return float(np.sqrt(np.mean(off**2)))

    (chosen,) = model.impute(problem.given)
    errors = {name: error(mean) for name, mean in model.candidates_.means(problem.given[0]).items()}
    return error(chosen.mean) / min(errors.values()), error(chosen.mean) / errors["linear"]


def main(which: str = "chosen") -> None:
    """Print a line for each model, and one for `best-of`."""
    every = list(problems({"chosen": CHOSEN_ON, "checked": CHECKED_ON}[which]))
    for name, make in MODELS.items():
        rows = [
            compare_variances(Calibrated(make()).fit(problem.train), problem) for problem in every
        ]
        means: list[float] = np.mean(rows, axis=0).round(3).tolist()
        print(f"{name:16}", *means, f"{len(rows)} problems", flush=True)
    beside = np.array([ratios(problem) for problem in every])
    print("best-of", np.exp(np.log(beside).mean(axis=0)).round(3), beside.max(axis=0).round(2))


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(*sys.argv[1:])
