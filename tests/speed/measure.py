"""Measure one way in a process of its own: `python measure.py SIZE HOW MOST_GB`, SIZE as JSON."""

from __future__ import annotations

import json
import resource
import sys
from timeit import repeat, timeit

from problems import Size, pose
from ways import evaluation, peak_mb

ENOUGH_SECONDS = 2.0
ENOUGH_ROUNDS = 20


def main(size: str, how: str, most_gb: str) -> None:
    """Print the least seconds of an evaluation and the peak memory, whole and beyond imports."""
    most = int(float(most_gb) * 2**30)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    before = peak_mb()
    evaluate = evaluation(pose(Size(**json.loads(size))), how)
    first = timeit(evaluate, number=1)
    rounds = min(ENOUGH_ROUNDS, int(ENOUGH_SECONDS / first))
    seconds = min([first, *repeat(evaluate, number=1, repeat=rounds)])
    peak = peak_mb()
    print(json.dumps({"seconds": seconds, "peak_mb": peak, "own_mb": peak - before}))


if __name__ == "__main__":
    main(*sys.argv[1:])
