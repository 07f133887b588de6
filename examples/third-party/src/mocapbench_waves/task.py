"""Noisy waves with a gap."""

from __future__ import annotations

from functools import partial

import numpy as np

from mocapbench.benchmark import Case, ImputeProblem, Profile, Seeds, Task, hide_frames
from mocapbench.datasets import Archive, Recording
from mocapbench.reports import TaskPage

__all__ = ["waves", "waves_problem"]

N_FRAMES = 60
N_WAVES = 4
NOISE = 0.05


def waves_problem(length: int, seeds: Seeds, archive: Archive) -> ImputeProblem:
    """Return three whole waves and one with a gap of ``length`` frames, each of two channels.

    Phases and noise are drawn from the stream ``data``, the place of the gap from ``mask``.
    """
    del archive  # nothing is read
    rng = seeds.generator("data")
    *whole, last = (_wave(rng, f"wave-{number}") for number in range(N_WAVES))
    start = int(seeds.generator("mask").integers(1, N_FRAMES - length))
    return ImputeProblem.of_one(last, hide_frames(start, start + length, N_FRAMES, 2), whole)


def _wave(rng: np.random.Generator, name: str) -> Recording:
    times = np.linspace(0.0, 2.0, N_FRAMES)
    angles = 2 * np.pi * times + rng.uniform(0, 2 * np.pi)
    values = np.column_stack([np.sin(angles), np.cos(angles)])
    values += NOISE * rng.standard_normal(values.shape)
    return Recording(name, times, values, ("sine", "cosine"), ("", ""))


waves = Task(
    name="waves",
    version=1,
    requires={"fills frames"},
    cases=tuple(
        Case(f"gap of {length}", partial(waves_problem, length), {"gap": length})
        for length in (5, 15)
    ),
    profiles={
        "smoke": Profile(("gap of 5",), folds=3),
        "quick": Profile(("gap of 5", "gap of 15"), folds=5),
        "paper": Profile(("gap of 5", "gap of 15"), folds=20),
    },
    page=TaskPage(
        title="Waves with a gap",
        reference="mocapbench-waves",
        description="Fill a gap in a noisy wave, given three whole ones of other phases.",
        question="hidden-frames",
        metrics=("mse", "median_absolute_error"),
    ),
)
"""Five or fifteen of sixty frames are hidden in the last of four waves."""
