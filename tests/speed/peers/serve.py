"""The peers' side of the pipe: a likelihood and its gradient for every line that comes in."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

__all__ = ["serve"]


def serve(pose: Callable[[np.lib.npyio.NpzFile], Callable[[], tuple[float, np.ndarray]]]) -> None:
    """Read the problem that the command line names and answer until the input ends.

    ``pose`` returns what evaluates a problem; gradients come in the coordinates and the order of
    the problem's own: for each layer log ℓ, W, √κ, then log β.
    """
    answers, sys.stdout = sys.stdout, sys.stderr  # the libraries may print
    evaluate = pose(np.load(sys.argv[1]))
    for _ in sys.stdin:
        value, gradient = evaluate()
        answer = {"value": value, "gradient": gradient.tolist(), "peak_mb": _peak_mb()}
        print(json.dumps(answer), file=answers, flush=True)


def _peak_mb() -> float:
    status = Path("/proc/self/status").read_text()
    (line,) = (line for line in status.splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) / 1024
