"""From errors in rehearsals to the weights of models."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mocapbench.baselines.choosing.panel import LAST_RESORT
from mocapbench.baselines.choosing.rehearsals import Errors, Rehearsals

__all__ = ["evidence", "expected_errors", "weights_of"]

_LEAST = 1e-12
"""Least squared error, in units of the channels' scales."""


def evidence(rehearsals: Rehearsals) -> Sequence[Errors]:
    """Return the squared error to expect of each model in the gaps, by each source there is.

    The sources are copies of the gaps in the recording itself, which knows the person, and training
    recordings that take its place, which know such gaps in such motions. Where copies had to be
    shorter than the gaps, the first is multiplied by how much larger the model's error is in
    training with the gaps than with such copies; where that is not known, training counts alone.
    Without a gap there is no source.
    """
    if rehearsals.given.visible.all():
        return []
    own, in_training = _means(rehearsals.own()), rehearsals.in_training()
    gaps = _means(with_gaps for with_gaps, _ in in_training)
    copies = _means(with_copies for _, with_copies in in_training) if rehearsals.are_short else gaps
    both = [name for name in own if name in gaps and name in copies]
    if not both:
        return [alone for alone in [gaps or own] if alone]
    grown = {name: own[name] * gaps[name] / copies[name] for name in both}
    return [grown, {name: gaps[name] for name in both}]


def _means(errors: Iterable[Errors]) -> Errors:
    """Return the mean error of each model that has one in every rehearsal."""
    every: Sequence[Errors] = [found for found in errors if found]
    names = [name for name in every[0] if all(name in found for found in every)] if every else []
    return {name: _LEAST + float(np.mean([found[name] for found in every])) for name in names}


def expected_errors(sources: Sequence[Errors]) -> Errors:
    """Return the geometric mean over the sources of the error to expect of each model."""
    names = sources[0] if sources else ()
    return {
        name: float(np.exp(np.mean([np.log(errors[name]) for errors in sources]))) for name in names
    }


def weights_of(sources: Sequence[Errors], power: float) -> Mapping[str, float]:
    """Return the weights of models, which sum to one: ∝ error^(−power) of the root errors.

    The factors of the sources are multiplied, so that two of them decide more than one. Without any
    source the last resort has all the weight.
    """
    errors = expected_errors(sources)
    if not errors:
        return {LAST_RESORT: 1.0}
    least, exponent = min(errors.values()), 0.5 * power * len(sources)
    raw = {name: (least / error) ** exponent for name, error in errors.items()}
    return {name: weight / sum(raw.values()) for name, weight in raw.items()}
