"""Small recordings, and models fitted to them, for the checks of models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mocapbench.baselines import Informed, Misinformed
from mocapbench.datasets import Recording, ToyProcess

__all__ = ["COMPLETE", "GAP", "SCATTERED", "TIMES", "Subject", "problem"]

TIMES = np.linspace(0.0, 2.0 * np.pi, 20)
_PROCESS = ToyProcess.random(np.random.default_rng(5), n_outputs=2, noise=0.01)
_OTHER_PROCESS = ToyProcess.random(np.random.default_rng(8), n_outputs=2, noise=0.01)
COMPLETE = _PROCESS.draw(np.random.default_rng(6), TIMES, 4)
GAP = np.repeat(((np.arange(20) > 7) & (np.arange(20) < 12))[:, None], 2, axis=1)
SCATTERED = np.random.default_rng(7).random((20, 2)) < 0.5

_BUDGET = {"max_iter": 20, "n_restarts": 1}


def problem(hidden: np.typing.NDArray[np.bool_]) -> tuple[Recording, ...]:
    """Return four recordings, the last with ``hidden`` (20, 2) entries."""
    return (*COMPLETE[:-1], COMPLETE[-1].hide(hidden))


@dataclass(frozen=True)
class Subject:
    """A model under test.

    Parameters
    ----------
    model : type
        Its abilities are what it inherits.
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
        if isinstance(model, Informed):
            model.inform(_PROCESS)
        if isinstance(model, Misinformed):
            model.misinform(_OTHER_PROCESS)
        return model

    def fit_model(self, recordings: Sequence[Recording], seed: int = 0, **parameters: Any) -> Any:
        """Return a model fitted to ``recordings``."""
        return self.build(seed, **parameters).fit(recordings)
