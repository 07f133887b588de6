"""The user's own models, as they are handed over: instances of models, or of scikit-learn's."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any, Self, cast

import numpy as np
from sklearn.base import clone
from sklearn.exceptions import NotFittedError

from mocapbench.baselines import FrameImputer, Imputer, Inductive, Model, Prediction
from mocapbench.benchmark.filling.requests.request import BEST
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import Recording

__all__ = ["ArrayImputer", "ModelLike", "lend_models", "name_model", "require_model"]

ModelLike = str | FrameImputer | Any
"""The name of a registered model, a model, or an imputer of scikit-learn for arrays with NaN."""


class ArrayImputer(Imputer, Inductive):
    """An imputer of scikit-learn, such as ``KNNImputer``, which sees frames and no times.

    Parameters
    ----------
    imputer : object
        With ``fit`` and ``transform``, for arrays (frames, channels) in which NaN is hidden.
    """

    def __init__(self, imputer: Any) -> None:
        self.imputer = imputer

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Fit the imputer to the frames of all recordings."""
        frames = np.concatenate([recording.values for recording in recordings])
        self.imputer_: Any = clone(self.imputer).fit(frames)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return what the imputer puts where entries are hidden."""
        if not hasattr(self, "imputer_"):
            raise NotFittedError("expected a fitted model; call fit first")
        return [self._impute(recording) for recording in recordings]

    def _impute(self, recording: Recording) -> Prediction:
        filled = np.asarray(self.imputer_.transform(recording.values), dtype=float)
        if filled.shape != recording.values.shape:
            raise ValueError(
                f"expected {type(self.imputer).__name__} to return an array of shape "
                f"{recording.values.shape}, got {filled.shape}; it may drop channels that are "
                "hidden throughout, or add columns"
            )
        return Prediction.around(recording, filled)


def name_model(model: ModelLike) -> str:
    """Return the name of a registered model, or that of the class of the user's own."""
    return model if isinstance(model, str) else type(model).__name__


@contextmanager
def lend_models(
    models: Mapping[str, ModelLike],
) -> Iterator[Mapping[str, Callable[[], FrameImputer]]]:
    """Register the user's own models within the context, and yield what builds each of them.

    Parameters
    ----------
    models : mapping of str to model
        By the names that they are called; names of registered models stand for these.

    Raises
    ------
    ValueError
        If one is no model, or has the name of a registered one.
    """
    own = {
        name: partial(clone, _wrap_model(model))
        for name, model in models.items()
        if not isinstance(model, str)
    }
    taken = sorted({*own} & {*MODELS.names()})
    if taken:
        raise ValueError(
            f"expected another name for a model of your own than that of a registered one, got "
            f"{', '.join(taken)}"
        )
    with ExitStack() as stack:
        for name, build in own.items():
            stack.enter_context(MODELS.lend(name, cast("type[Model]", build)))
        yield own


def require_model(model: ModelLike) -> None:
    """Refuse what is neither the name of a model nor one.

    Raises
    ------
    ValueError
        The message says what is.
    """
    if not isinstance(model, str):
        _wrap_model(model)
    elif model != BEST:
        MODELS.get(model)


def _wrap_model(model: ModelLike) -> FrameImputer:
    """Return a model; that of scikit-learn as one of recordings."""
    if isinstance(model, FrameImputer):
        return model
    if not isinstance(model, type) and hasattr(model, "fit") and hasattr(model, "transform"):
        return ArrayImputer(model)
    kind = model.__name__ if isinstance(model, type) else type(model).__name__
    got = f"the class {kind}; write {kind}()" if isinstance(model, type) else f"an object of {kind}"
    raise ValueError(
        "expected the name of a model, an instance of mocapbench.baselines.FrameImputer, or an "
        f"imputer of scikit-learn with fit and transform, got {got}"
    )
