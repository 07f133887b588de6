"""Noisy waves with a gap."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import FrameImputer
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.masks import hide_frames
from mocapbench.benchmark.tasks.base import Case, Selection, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording

__all__ = ["Waves", "waves"]

N_FRAMES = 60
N_WAVES = 4
NOISE = 0.05


class Waves(Task):
    """Three whole waves and one with a gap, each of two channels."""

    name = "waves"
    version = 1
    title = "Waves with a gap"
    reference = "mocapbench-waves"
    description = "Fill a gap in a noisy wave, having seen three whole ones of other phases."
    requires = (FrameImputer,)
    cases = tuple(Case(f"gap of {length}", {"gap": length}) for length in (5, 15))
    metrics = ("mse", "median_absolute_error")
    profiles = {
        "smoke": Selection(("gap of 5",), folds=3),
        "quick": Selection(("gap of 5", "gap of 15"), folds=5),
        "paper": Selection(("gap of 5", "gap of 15"), folds=20),
    }

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> ImputeProblem:
        """Draw phases and noise from the stream ``data``, the gap from ``mask``."""
        del archive  # nothing is read
        rng, length = seeds.generator("data"), int(case.settings["gap"])
        *whole, last = (_wave(rng, f"wave-{number}") for number in range(N_WAVES))
        start = int(seeds.generator("mask").integers(1, N_FRAMES - length))
        given = last.hide(hide_frames(start, start + length, N_FRAMES, 2))
        return ImputeProblem(
            train=(*whole, given),
            process=None,
            given=(given,),
            truth=(last.values,),
            unit=Unit.natural(2),
        )


def _wave(rng: np.random.Generator, name: str) -> Recording:
    times = np.linspace(0.0, 2.0, N_FRAMES)
    angles = 2 * np.pi * times + rng.uniform(0, 2 * np.pi)
    values = np.column_stack([np.sin(angles), np.cos(angles)])
    values += NOISE * rng.standard_normal(values.shape)
    return Recording(name, times, values, ("sine", "cosine"), ("", ""))


waves = Waves()
