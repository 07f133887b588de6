"""What the scores of synthesis see of real recordings that are repeated.

It is reported in `docs/results/gaussian-processes.md`.

::

    python docs/evidence/replay.py

prints, for a case of each task that synthesises motion, the MLC, the MCC and the variance ratio of
each training recording by itself, of all of them in equal parts, and of the same with a posture for
each sample: a constant added to every channel, normal with 0.6 times its standard deviation.

Recordings are read from the folder in the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.baselines import Replay
from mocapbench.benchmark import METRICS, TASKS, Address, Seeds, archive_at
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem

CASES = {
    "walking-synthesis": "without 38(2)",
    "exaggerated-synthesis": "without 38(2)",
    "soccer-synthesis": "all five",
}
N_SAMPLES = 40
POSTURE = 0.6

Array = NDArray[np.float64]


def scores(problem: SynthesiseProblem, samples: Array) -> dict[str, float]:
    """Return the scores of samples (S, N, D)."""
    outcome = problem.outcome(samples)
    metrics = map(METRICS.get, ("mlc", "mcc", "variance_ratio"))
    return {metric.name: float(metric(outcome).value) for metric in metrics}


def repeated(problem: SynthesiseProblem) -> Iterator[tuple[str, Array]]:
    """Yield what is sampled, and samples."""
    alone = {
        recording.name: Replay().fit([recording]).sample(problem.times, N_SAMPLES, 0)
        for recording in problem.train
    }
    yield from alone.items()
    parts = np.concatenate([samples[: N_SAMPLES // len(alone)] for samples in alone.values()])
    yield "equal parts", parts
    spread = parts.std(axis=1, keepdims=True)
    postures = np.random.default_rng(0).standard_normal((len(parts), 1, parts.shape[2]))
    yield "equal parts, with postures", parts + POSTURE * spread * postures


def main() -> None:
    """Print the table."""
    archive = archive_at()
    rows = []
    for task, case in CASES.items():
        seeds = Seeds(0, Address(task, 1, case, 0))
        problem = TASKS.get(task).case(case).problem(seeds, archive)
        assert isinstance(problem, SynthesiseProblem)
        rows += [
            {"task": task, "samples": name, **scores(problem, samples)}
            for name, samples in repeated(problem)
        ]
    print(pd.DataFrame(rows).round(3).to_string(index=False))


if __name__ == "__main__":
    main()
