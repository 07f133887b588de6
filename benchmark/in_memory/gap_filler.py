"""A transformer of scikit-learn that fills arrays, so that any model stands in a pipeline."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, OneToOneFeatureMixin, TransformerMixin
from sklearn.utils import Tags
from sklearn.utils.validation import check_is_fitted, validate_data

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import join_names
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.benchmark.in_memory.arguments import require_positive, translate_errors
from mocapbench.benchmark.in_memory.gap_filling import solve_request
from mocapbench.benchmark.in_memory.own_models import ModelLike, name_model, require_model
from mocapbench.benchmark.in_memory.tables import require_different_names
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["GapFiller"]

_NAMED = 4


class GapFiller(OneToOneFeatureMixin, TransformerMixin, BaseEstimator):  # type: ignore[misc]
    """Fills NaN in arrays (frames, channels) whose rows follow each other in time.

    What it transforms is filled by a model that learns from it, and from the frames given to `fit`.
    All is filled, also before a channel is first seen and after it is last seen.

    Parameters
    ----------
    model : str or model, default="linear"
        What `mocapbench.fill` takes as a model.
    rate : float, default=1.0
        Frames per second.
    seed : int, default=0
        Of what models draw.

    Attributes
    ----------
    learnt_ : Recording
        The frames given to `fit`.
    n_features_in_ : int
        The number of channels.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench import GapFiller
    >>> GapFiller().fit_transform([[0.0], [np.nan], [2.0]]).ravel()
    array([0., 1., 2.])
    """

    def __init__(self, model: ModelLike = "linear", *, rate: float = 1.0, seed: int = 0) -> None:
        self.model = model
        self.rate = rate
        self.seed = seed

    def fit(self, X: ArrayLike, y: object = None) -> Self:
        """Keep frames to learn from.

        Parameters
        ----------
        X : array_like of shape (frames, channels)
            NaN is hidden.
        y : None
            Of no effect.
        """
        del y
        require_different_names([*map(str, getattr(X, "columns", ()))])
        values = validate_data(
            self, _show_masked(X), dtype=np.float64, ensure_all_finite="allow-nan"
        )
        with translate_errors():
            require_model(self.model)
        require_positive("rate", self.rate, "in frames per second, ")
        self.learnt_: Recording = self._record("learnt", values)
        return self

    def transform(self, X: ArrayLike) -> FrameByChannel:
        """Return frames without NaN.

        Parameters
        ----------
        X : array_like of shape (frames, channels)

        Returns
        -------
        ndarray of shape (frames, channels)

        Raises
        ------
        ValueError
            If nothing of a channel is visible here or was in `fit`, or the model does not fill it.
        """
        check_is_fitted(self)
        values: Array = validate_data(
            self,
            _show_masked(X),
            reset=False,
            dtype=np.float64,
            ensure_all_finite="allow-nan",
            copy=True,
        )
        if not np.isnan(values).any():
            return values
        given = self._record("given", values)
        known = np.array_equal(values, self.learnt_.values, equal_nan=True)
        train = () if known else (self.learnt_,)
        self._require_visible(given, *train)
        target, name = ~given.visible, name_model(self.model)
        request = FillRequest(given, target, np.full(int(target.sum()), name), train)
        return solve_request(request, {name: self.model}, seed=self.seed).recording.values.copy()

    def _record(self, name: str, values: Array) -> Recording:
        n_frames, n_channels = values.shape
        channels = tuple(getattr(self, "feature_names_in_", [f"x{k}" for k in range(n_channels)]))
        return Recording(
            name, np.arange(n_frames) / self.rate, values, channels, ("",) * n_channels
        )

    def _require_visible(self, *recordings: Recording) -> None:
        seen = np.any([one.visible.any(axis=0) for one in recordings], axis=0)
        if not seen.all():
            lost = [recordings[0].channels[k] for k in np.flatnonzero(~seen)]
            raise ValueError(
                "expected a visible entry of each channel, here or in fit, got none of "
                f"{join_names(lost, _NAMED)}; leave it out"
            )

    def __sklearn_tags__(self) -> Tags:
        tags: Any = super().__sklearn_tags__()
        tags.input_tags.allow_nan = True
        return tags


def _show_masked(X: ArrayLike) -> ArrayLike:
    """Return an array with NaN where a mask hides entries, of which scikit-learn knows nothing."""
    return np.ma.filled(X.astype(float), np.nan) if isinstance(X, np.ma.MaskedArray) else X
