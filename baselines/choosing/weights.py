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

    Where the recording has room for copies of its gaps, it is the mean error there. Where copies
    are shorter than the gaps, it is multiplied by how much larger the model's error is in training
    recordings with the gaps than with the copies. With no room at all, training alone counts.
    Without a gap there is no error to expect.
    """
    if rehearsals.given.visible.all():
        return {}
    own = _means(rehearsals.own())
    if own and not rehearsals.are_short:
        return own
    in_training = rehearsals.in_training()
    gaps = _means(with_gaps for with_gaps, _ in in_training)
    copies = _means(with_copies for _, with_copies in in_training)
    if not own or not gaps:
        return own or gaps
    growth = {name: gaps[name] / copies[name] for name in gaps if name in copies}
    return {name: own[name] * growth[name] for name in own if name in growth} or own


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
