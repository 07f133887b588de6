"""Rules by which the user takes single gaps in hand: what stays open, and which model fills what.

A rule is a name of a marker, joint or channel, or a pattern as those of a shell, and perhaps frames
(0-based, both ends meant): ``LKNE``, ``L*:412-455``. No rule changes what models are fitted to.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.requests.names import match_pattern
from mocapbench.benchmark.filling.requests.refusals import explain_no_named_gap
from mocapbench.datasets import Mask, Recording

__all__ = ["BEST", "assign_models", "mark_left"]

BEST = "best"
"""In place of a model's name: the one with the least error in held-out gaps of its kind."""
_WITH_FRAMES = re.compile(r"(.+):(\d{1,9})-(\d{1,9})", re.DOTALL)
_ALL = "*"


def mark_left(
    recording: Recording, target: Mask, leave: Sequence[str], only: Sequence[str]
) -> Mask:
    """Return which of the entries to fill (N, D) stay open by the user's hand.

    Parameters
    ----------
    recording : Recording
    target : ndarray of bool of shape (N, D)
        The entries to fill.
    leave, only : sequence of str
        Rules of what stays open, and of outside what all else does.

    Raises
    ------
    UsageError
        If a rule cannot be read, or names nothing that is to be filled.
    """
    left = np.zeros_like(target)
    for rule in leave:
        left |= _mark_named(recording, target, "--leave", rule)
    named = [_mark_named(recording, target, "--only", rule) for rule in only]
    return left | (target & ~np.any(named, axis=0)) if named else left


def assign_models(recording: Recording, target: Mask, rules: str) -> NDArray[np.str_]:
    """Return the model that each entry to fill (M,) has by the first rule that names it, or `BEST`.

    Parameters
    ----------
    recording : Recording
    target : ndarray of bool of shape (N, D)
        The entries to fill.
    rules : str
        Such as ``LKNE=linear,R*:0-99=makima,best``, in which a bare model is for all.

    Raises
    ------
    UsageError
        If a rule cannot be read, names nothing that is to be filled, or comes too late.
    """
    models, numbers = [BEST], np.zeros(target.shape, dtype=np.int32)
    waiting = target.copy()
    for number, (rule, model) in enumerate(_parse_models(rules), start=1):
        marked = _mark_named(recording, target, "--model", rule) & waiting
        if rule != _ALL and not marked.any():
            raise UsageError(
                f"--model: expected rules of which each is the first for a gap, got {rule!r} "
                f"after others for the same gaps in {rules!r}; put it before them"
            )
        models.append(model)
        numbers[marked] = number
        waiting &= ~marked
    return np.array(models)[numbers[target]]


def _parse_models(rules: str) -> Iterator[tuple[str, str]]:
    """Yield the rules of ``--model``, each with its model."""
    for text in rules.split(","):
        # Models have no equals sign in their names, and markers may have.
        rule, equals, model = (part.strip() for part in text.rpartition("="))
        if not model or (equals and not rule):
            raise UsageError(
                "--model: expected a model, or rules such as 'LKNE=linear,R*:0-99=makima,*=best', "
                f"got {rules!r}"
            )
        yield rule or _ALL, model


def _mark_named(recording: Recording, target: Mask, option: str, rule: str) -> Mask:
    """Return which of the entries to fill (N, D) a rule of an option names.

    Raises
    ------
    UsageError
        If there are none.
    """
    pattern, frames = _parse_rule(option, rule)
    named = np.zeros_like(target)
    named[frames] = target[frames]
    named &= match_pattern(recording.channels, pattern)
    if not named.any():
        said = explain_no_named_gap(recording.channels, target, pattern, rule)
        raise UsageError(f"{recording.name}: {option}: {said}")
    return named


def _parse_rule(option: str, rule: str) -> tuple[str, slice]:
    """Return the pattern of a rule, and the frames that it is for."""
    found = _WITH_FRAMES.fullmatch(rule)
    if found is None:
        return rule, slice(None)
    first, last = int(found[2]), int(found[3])
    if first > last:
        raise UsageError(
            f"{option}: expected the first frame before the last, as in LKNE:{last}-{first}, "
            f"got {rule!r}"
        )
    return found[1], slice(first, last + 1)
