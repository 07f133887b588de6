"""Seconds and memory of the fills that `docs/results/filling.md` reports, as recordings grow.

::

    export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
    python docs/evidence/fill_growth.py

prints for three models, intervals checked, the processor seconds of a fill and the most memory that
its process holds: three gaps of thirty frames in made recordings of 93 channels, of whole frames
for `pose-kriging` and of a limb for the others. The recordings beside are half as long.
"""

from __future__ import annotations

import resource
import time
from typing import Any

from fill_costs import Grid, make_problem

from mocapbench.basics.child import call_in_child
from mocapbench.benchmark.filling.fill_attempt import attempt_fill
from mocapbench.benchmark.registry import MODELS, find_calibration

KINDS = {
    "pose-kriging": ("joints", "frames"),
    "channel-kriging": ("joints", "limb"),
    "marker-kriging": ("markers", "limb"),
}
SIZES = ((600, 0), (600, 2), (10_000, 0), (100_000, 0))
"""Frames, and recordings beside."""
LONGEST, MEMORY = 7200.0, 16 * 2**30
"""Seconds and bytes that a fill may take."""


def count_cost(name: str, n_frames: int, n_train: int) -> tuple[float, float, str]:
    """Return the processor seconds of a fill, the gigabytes of its process, and why it failed."""
    kind, extent = KINDS[name]
    problem = make_problem(Grid(kind, n_frames, 93, 3, 30, extent, n_train))
    model: Any = MODELS.get(name)
    began, calibration = time.process_time(), find_calibration(name)
    made = attempt_fill(model, problem, MEMORY, seconds=LONGEST, calibration=calibration)
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    return time.process_time() - began, most, made.failure


def main() -> None:
    """Print a line for each model and size."""
    for name in KINDS:
        for n_frames, n_train in SIZES:
            seconds, most, failure = call_in_child(
                count_cost, name, n_frames, n_train, timeout=2 * LONGEST
            )
            print(
                f"{name:16} {n_frames:6} frames, {n_train} beside: {seconds:.2f} s, {most:.2f} GB",
                failure,
                flush=True,
            )


if __name__ == "__main__":
    main()
