"""Other people's libraries, each in a process and an environment of its own."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any, Self

import numpy as np
from problems import Problem

__all__ = ["Peer"]

SCRIPTS = Path(__file__).with_name("peers")


class Peer:
    """A process that evaluates one problem whenever it is asked.

    Parameters
    ----------
    python : str
        The interpreter that has the library.
    script : str
        The module of ``peers/`` that speaks for it.
    problem : Problem
        What to evaluate.
    folder : Path
        Where the problem is written for the process to read.
    """

    def __init__(self, python: str, script: str, problem: Problem, folder: Path) -> None:
        path = folder / "problem.npz"
        _write(problem, path)
        self.process = subprocess.Popen(
            [python, str(SCRIPTS / f"{script}.py"), str(path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.process.communicate()

    def evaluate(self) -> dict[str, Any]:
        """Return the value, the gradient and the process's peak memory."""
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


def _write(problem: Problem, path: Path) -> None:
    layers = {
        f"{name} {leaf}": values
        for name, layer in problem.parameters.layers.items()
        for leaf, values in (
            ("lengthscales", layer.lengthscales),
            ("weights", layer.weights),
            ("kappa", layer.kappa),
        )
    }
    replicates = problem.replicates
    np.savez(
        path,
        times=replicates.times,
        data=replicates.data,
        observed=replicates.observed,
        kernel=problem.kernel_name,
        noise=problem.parameters.noise,
        **layers,
    )
