"""The ways to compute one log-likelihood with its full gradient, and the memory that one takes."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial
from pathlib import Path

import numpy as np
from naive import naive
from problems import Problem, Size

from mocapbench.baselines.gp.solvers.planner import PLANS

__all__ = ["evaluation", "measured", "peak_mb"]


def evaluation(problem: Problem, how: str) -> Callable[[], tuple[float, np.ndarray]]:
    """Return what evaluates the problem by the yardstick, a named solver or the planner."""
    if how == "naive":
        return partial(naive, problem)
    solvers = PLANS[how](problem.kernel, problem.reduction.blocks, problem.parameters)
    return partial(problem.reduction.evaluate, solvers, problem.parameters)


def measured(
    size: Size, how: str, *, most_gb: float, timeout: float | None = None
) -> Mapping[str, float]:
    """Return the seconds and the peak memory of a process that does nothing else.

    Raises
    ------
    subprocess.SubprocessError
        If it fails, for want of ``most_gb`` of address space or otherwise, or takes too long.
    """
    script = Path(__file__).with_name("measure.py")
    command = [sys.executable, str(script), json.dumps(asdict(size)), how, str(most_gb)]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, timeout=timeout)
    return json.loads(done.stdout)


def peak_mb() -> float:
    """Return the most memory that this process has had in use.

    The kernel's own figure for the image that runs now: ``ru_maxrss`` would count what the
    parent held when it started the process.
    """
    status = Path("/proc/self/status").read_text()
    (line,) = (line for line in status.splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) / 1024
