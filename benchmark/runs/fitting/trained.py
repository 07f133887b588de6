"""Fitted models, as they are handed to all problems that train on the same recordings.

What a model learns follows from the training recordings, its parameters and its seed alone
(`mocapbench.baselines.Model.fit`). Problems that have all three in common need one fit.
"""

from __future__ import annotations

import pickle
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import joblib

from mocapbench.basics.whole_files import atomic_write
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.runs.fitting.solve import FitCosts, Fitted
from mocapbench.benchmark.runs.posed import digest_recording

__all__ = ["Trained", "TrainedModels"]


@dataclass(frozen=True)
class Trained:
    """A fitted model that other processes can load.

    Parameters
    ----------
    key : str
        Its training key.
    state : bytes
        The model, pickled.
    learnt_from : str
        Digest of what it was fitted to.
    costs : FitCosts
        Of its fit.
    internals : mapping of str to ndarray
        Of the model.
    """

    key: str
    state: bytes
    learnt_from: str
    costs: FitCosts
    internals: Arrays

    @classmethod
    def of(cls, key: str, fitted: Fitted, problem: Problem[Any]) -> Self | None:
        """Return a model that was fitted to ``problem``; None if it cannot be pickled."""
        try:
            state = pickle.dumps(fitted.model, protocol=pickle.HIGHEST_PROTOCOL)
        except Exception:  # a user's class raises what it likes
            return None
        # After the model has been pickled, so that predictions do not depend on them.
        _, costs, internals = fitted.with_internals(problem)
        return cls(key, state, _digest(problem), costs, internals or {})

    def suits(self, problem: Problem[Any]) -> bool:
        """Return whether ``problem`` trains on the same recordings."""
        return self.learnt_from == _digest(problem)

    def load(self) -> Fitted:
        """Return a copy of the model, which the caller may change."""
        return Fitted(pickle.loads(self.state), self.costs, self.internals)


def _digest(problem: Problem[Any]) -> str:
    return str(joblib.hash((list(map(digest_recording, problem.train)), problem.process)))


class TrainedModels:
    """The fitted models of one run, as files.

    Parameters
    ----------
    folder : Path
        Where the files are; each is named by its training key.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def save(self, trained: Trained) -> None:
        """Keep a fitted model."""
        with atomic_write(self._folder / trained.key) as file:
            pickle.dump(trained, file, protocol=pickle.HIGHEST_PROTOCOL)

    def load(self, key: str) -> Trained | None:
        """Return the fitted model called ``key``, or None if there is none."""
        path = self._folder / key
        if not key or not path.exists():
            return None
        trained: Trained = pickle.loads(path.read_bytes())
        return trained
