"""From errors in rehearsals to the weights of models."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mocapbench.baselines.choosing.panel import LAST_RESORT
from mocapbench.baselines.choosing.rehearsals import Errors, Rehearsals

__all__ = ["expected_errors", "weights_of"]

_LEAST = 1e-12
"""Least squared error, in units of the channels' scales."""


def expected_errors(rehearsals: Rehearsals) -> Errors:
    """Return the squared error to expect of each model in the gaps.

    It is the geometric mean of the errors in the recording itself and in training recordings that
    take its place: the first knows the person, the second knows such gaps in such motions. Where
    copies of the gaps in the recording had to be shorter, the first is multiplied by how much
    larger the model's error is in training with the gaps than with such copies. Where one of the
    two is missing the other counts alone; without a gap there is no error to expect.
    """
    if rehearsals.given.visible.all():
        return {}
    own, in_training = _means(rehearsals.own()), rehearsals.in_training()
    gaps = _means(with_gaps for with_gaps, _ in in_training)
    copies = _means(with_copies for _, with_copies in in_training) if rehearsals.are_short else gaps
    if not own or not gaps:
        return own or gaps
    both = [name for name in own if name in gaps and name in copies]
    return {name: gaps[name] * float(np.sqrt(own[name] / copies[name])) for name in both} or own


def _means(errors: Iterable[Errors]) -> Errors:
    """Return the mean error of each model that has one in every rehearsal."""
    every: Sequence[Errors] = [found for found in errors if found]
    names = [name for name in every[0] if all(name in found for found in every)] if every else []
    return {name: _LEAST + float(np.mean([found[name] for found in every])) for name in names}


def weights_of(errors: Errors, power: float) -> Mapping[str, float]:
    """Return the weights of models, which sum to one: ∝ error^(−power) of the root error.

    Without any error the last resort has all the weight.
    """
    if not errors:
        return {LAST_RESORT: 1.0}
    least = min(errors.values())
    raw = {name: (least / error) ** (0.5 * power) for name, error in errors.items()}
    return {name: weight / sum(raw.values()) for name, weight in raw.items()}
