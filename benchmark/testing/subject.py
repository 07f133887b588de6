"""Small recordings, and models fitted to them, for the checks of models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.datasets import Recording, ToyProcess

__all__ = ["COMPLETE", "END", "GAP", "SCATTERED", "TIMES", "Subject", "problem"]

TIMES = np.linspace(0.0, 2.0 * np.pi, 20)
_PROCESS = ToyProcess.random(np.random.default_rng(5), n_outputs=2, noise=0.01)
_OTHER_PROCESS = ToyProcess.random(np.random.default_rng(8), n_outputs=2, noise=0.01)
COMPLETE = _PROCESS.draw(np.random.default_rng(6), TIMES, 4)
GAP = np.repeat(((np.arange(20) > 7) & (np.arange(20) < 12))[:, None], 2, axis=1)
END = np.repeat((np.arange(20) > 13)[:, None], 2, axis=1)
SCATTERED = np.random.default_rng(7).random((20, 2)) < 0.5

_BUDGET = {"max_iter": 20, "n_restarts": 1, "n_seen": 4, "n_ahead": 6}


def problem(hidden: np.typing.NDArray[np.bool_]) -> tuple[Recording, ...]:
    """Return four recordings, the last with ``hidden`` (20, 2) entries."""
    return (*COMPLETE[:-1], COMPLETE[-1].hide(hidden))


@dataclass(frozen=True)
class Subject:
    """A model under test.

    Parameters
    ----------
    model : type
    parameters : mapping
        Set on every instance, over a budget that keeps searches short.
    """

    model: type[Any]
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def build(self, seed: int = 0, **parameters: Any) -> Any:
        """Return an unfitted model."""
        model = self.model()
        usual = {**_BUDGET, "random_state": seed}
        known = {name: value for name, value in usual.items() if name in model.get_params()}
        model.set_params(**{**known, **self.parameters, **parameters})
        return model

    def fit_model(self, recordings: Sequence[Recording], seed: int = 0, **parameters: Any) -> Any:
        """Return a model fitted to ``recordings``."""
        return self.fit_built(self.build(seed, **parameters), recordings)

    def fit_built(self, model: Any, recordings: Any) -> Any:
        """Return what the ``fit`` of an unfitted model returns that is given all that it needs."""
        posed = SynthesiseProblem(
            recordings, TIMES, 1, (), process=_PROCESS, control=_OTHER_PROCESS
        )
        return posed.fit(model)
