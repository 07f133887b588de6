"""The models that `BestOf` chooses from, fitted to the same recordings."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from functools import partial
from typing import Self, TypeVar

from mocapbench.baselines.aligned_window import AlignedWindow
from mocapbench.baselines.calibrated import Calibrated
from mocapbench.baselines.channel_kriging import ChannelKriging
from mocapbench.baselines.choosing.jointly import Jointly
from mocapbench.baselines.common.markers import markers_of
from mocapbench.baselines.fam import FAM
from mocapbench.baselines.interpolation import (
    CubicSplineImputer,
    LinearImputer,
    MakimaImputer,
    PchipImputer,
)
from mocapbench.baselines.lds import LDS
from mocapbench.baselines.low_rank import LowRank
from mocapbench.baselines.marker_kriging import MarkerKriging
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.nn import NN
from mocapbench.baselines.pca_regression import PCARegression
from mocapbench.baselines.pose_kriging import PoseKriging
from mocapbench.baselines.protocols import FrameImputer, Prediction
from mocapbench.baselines.rigid_body import RigidBody
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["CANDIDATES", "LAST_RESORT", "OF_MARKERS", "FittedCandidates"]

Tried = TypeVar("Tried")
Result = TypeVar("Result")

LAST_RESORT = "pchip"
"""What fills where nothing can be held out: it never overshoots."""


def _mohgp(n_components: int | Mapping[str, int], registration: str = "none") -> Jointly:
    """Return a hierarchy that is learnt in one short search.

    On toy data it is as accurate as one learnt in five searches, in a tenth of their time.
    """
    return Jointly(
        MOHGP(n_components=n_components, registration=registration, n_restarts=1, max_iter=60)
    )


CANDIDATES: Mapping[str, Callable[[], FrameImputer]] = {
    "linear": LinearImputer,
    LAST_RESORT: PchipImputer,
    "makima": MakimaImputer,
    "cubic-spline": CubicSplineImputer,
    "lds": lambda: Calibrated(LDS()),
    "fam": lambda: Calibrated(FAM(n_restarts=1, max_iter=10, random_state=0)),
    "low-rank": lambda: Calibrated(LowRank()),
    "pca-regression": PCARegression,
    "nn": NN,
    "aligned-window": AlignedWindow,
    "pose-kriging": PoseKriging,
    "channel-kriging": lambda: Calibrated(ChannelKriging()),
    "mohgp": partial(_mohgp, 3),
    "mohgp-registered": partial(_mohgp, {"parent": 1, "child": 5}, "affine"),
}
"""All are inductive, and take a few seconds at most, but for those that are `Jointly`: these take
part where recordings are so small that they take about a minute."""
OF_MARKERS: Mapping[str, Callable[[], FrameImputer]] = {
    "rigid-body": RigidBody,
    "marker-kriging": MarkerKriging,
}
"""Candidates besides, where channels are coordinates of markers."""


class FittedCandidates:
    """Fitted models by name, and why others are not among them.

    Parameters
    ----------
    models : mapping of str to FrameImputer
    left_out : mapping of str to str, optional
        What those said, by name, that cannot learn from the recordings.
    """

    def __init__(
        self, models: Mapping[str, FrameImputer], left_out: Mapping[str, str] | None = None
    ) -> None:
        self.models = models
        self.left_out: Mapping[str, str] | dict[str, str] = left_out or {}

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> Self:
        """Fit every candidate that can be fitted."""
        has_markers = markers_of(recordings[0].channels, recordings[0].units)
        candidates = {**CANDIDATES, **OF_MARKERS} if has_markers else CANDIDATES
        return cls(*_try_each(candidates, lambda new: new().fit(recordings)))

    def anew(self, recordings: Sequence[Recording]) -> Self:
        """Return the models fitted to other recordings; `Jointly` keeps its parameters."""
        models, left_out = _try_each(self.models, partial(_anew, recordings=recordings))
        return type(self)(models, {**self.left_out, **left_out})

    def impute(self, recording: Recording, names: Iterable[str]) -> dict[str, Prediction]:
        """Return the predictions of some of the models, those that can fill the recording."""
        chosen = {name: self.models[name] for name in names}
        return _try_each(chosen, lambda model: model.impute([recording])[0])[0]

    def means(self, recording: Recording) -> dict[str, FrameByChannel]:
        """Return the means of `impute`, without the held-out gaps that variances need."""
        nominal, _ = _try_each(self.models, lambda model: model.impute_uncalibrated([recording])[0])
        return {name: prediction.mean for name, prediction in nominal.items()}


def _try_each(
    models: Mapping[str, Tried], call: Callable[[Tried], Result]
) -> tuple[dict[str, Result], dict[str, str]]:
    """Return what ``call`` returns for each model, and what those said that raise a ValueError."""
    results, refusals = {}, {}
    for name, model in models.items():
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                results[name] = call(model)
        except ValueError as error:
            refusals[name] = f"{type(error).__name__}: {error}"
    return results, refusals


def _anew(model: FrameImputer, recordings: Sequence[Recording]) -> FrameImputer:
    if isinstance(model, Jointly):
        return model.with_recordings(recordings)
    return copy(model).fit(recordings)
