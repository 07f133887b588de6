"""The models that `BestOf` chooses from, fitted to the same recordings."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from copy import copy
from dataclasses import dataclass, replace
from functools import partial
from typing import Self

from mocapbench.baselines.aligned_window import AlignedWindow
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
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rigid_body import RigidBody
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["CANDIDATES", "LAST_RESORT", "OF_MARKERS", "Panel"]

Impute = Callable[[Sequence[Recording]], list[Prediction]]

LAST_RESORT = "pchip"
"""What fills where no rehearsal has room: it never overshoots."""


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
    "lds": LDS,
    "fam": partial(FAM, n_restarts=1, max_iter=10, random_state=0),
    "low-rank": LowRank,
    "pca-regression": PCARegression,
    "nn": NN,
    "aligned-window": AlignedWindow,
    "pose-kriging": PoseKriging,
    "channel-kriging": ChannelKriging,
    "mohgp": partial(_mohgp, 3),
    "mohgp-registered": partial(_mohgp, {"parent": 1, "child": 5}, "affine"),
}
"""All are inductive, and take a few seconds at most."""
OF_MARKERS: Mapping[str, Callable[[], FrameImputer]] = {
    "rigid-body": RigidBody,
    "marker-kriging": MarkerKriging,
}
"""Candidates besides, where channels are coordinates of markers."""


@dataclass(frozen=True, eq=False)
class Panel:
    """Fitted models by name; those that cannot learn from the recordings are left out."""

    models: Mapping[str, FrameImputer]

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> Self:
        """Fit every candidate that can be fitted."""
        has_markers = markers_of(recordings[0].channels, recordings[0].units)
        candidates = {**CANDIDATES, **OF_MARKERS} if has_markers else CANDIDATES
        return cls(_fitted({name: new() for name, new in candidates.items()}, recordings))

    def anew(self, recordings: Sequence[Recording]) -> Self:
        """Return the models fitted to other recordings; `Jointly` keeps its parameters."""
        models = {name: copy(model) for name, model in self.models.items()}
        return replace(self, models=_fitted(models, recordings))

    def impute(self, recording: Recording, names: Iterable[str]) -> dict[str, Prediction]:
        """Return the predictions of some of the models, those that can fill the recording."""
        chosen = replace(self, models={name: self.models[name] for name in names})
        return chosen._filled(recording, lambda model: model.impute)

    def means(self, recording: Recording) -> dict[str, FrameByChannel]:
        """Return the means of `impute`, without the trials that variances need."""
        filled = self._filled(recording, _without_trials)
        return {name: prediction.mean for name, prediction in filled.items()}

    def _filled(
        self, recording: Recording, how: Callable[[FrameImputer], Impute]
    ) -> dict[str, Prediction]:
        predictions = {}
        for name, model in self.models.items():
            with _if_it_can():
                (predictions[name],) = how(model)([recording])
        return predictions


def _fitted(
    models: Mapping[str, FrameImputer], recordings: Sequence[Recording]
) -> Mapping[str, FrameImputer]:
    fitted = {}
    for name, model in models.items():
        with _if_it_can():
            fitted[name] = model.fit(recordings)
    return fitted


@contextmanager
def _if_it_can() -> Iterator[None]:
    """Leave a model out that expects other data: it refuses them with a ValueError."""
    with warnings.catch_warnings(), suppress(ValueError):
        warnings.simplefilter("ignore")
        yield


def _without_trials(model: FrameImputer) -> Impute:
    return model.as_claimed if isinstance(model, Widened) else model.impute
