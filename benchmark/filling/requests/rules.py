"""Rules by which the user takes single gaps in hand: what stays open, and which model fills what.

A rule is a name of a marker, joint or channel, or a pattern as those of a shell, and perhaps frames
(0-based, both ends meant): ``LKNE``, ``L*:412-455``. No rule changes what models are fitted to.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

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


@dataclass(frozen=True)
class _Rule:
    """A pattern, with the frames that it is for.

    Parameters
    ----------
    option, text : str
        As the user writes them.
    pattern : str
    frames : slice
    """

    option: str
    text: str
    pattern: str
    frames: slice

    def mark(self, recording: Recording, target: Mask) -> Mask:
        """Return which of the entries to fill (N, D) the rule names.

        Raises
        ------
        UsageError
            If there are none.
        """
        marked = np.zeros_like(target)
        marked[self.frames] = target[self.frames]
        marked &= match_pattern(recording.channels, self.pattern)
        if not marked.any():
            said = explain_no_named_gap(recording.channels, target, self.pattern, self.text)
            raise UsageError(f"{recording.name}: {self.option}: {said}")
        return marked


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
    for rule in _parse_rules("--leave", leave):
        left |= rule.mark(recording, target)
    named = [rule.mark(recording, target) for rule in _parse_rules("--only", only)]
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
        marked = rule.mark(recording, target) & waiting
        if rule.pattern != _ALL and not marked.any():
            raise UsageError(
                f"--model: expected rules of which each is the first for a gap, got {rule.text!r} "
                f"after others for the same gaps in {rules!r}; put it before them"
            )
        models.append(model)
        numbers[marked] = number
        waiting &= ~marked
    return np.array(models)[numbers[target]]


def _parse_models(rules: str) -> Iterator[tuple[_Rule, str]]:
    """Yield the rules of ``--model``, each with its model."""
    for text in rules.split(","):
        # Models have no equals sign in their names, and markers may have.
        pattern, equals, model = (part.strip() for part in text.rpartition("="))
        if not model or (equals and not pattern):
            raise UsageError(
                "--model: expected a model, or rules such as 'LKNE=linear,R*:0-99=makima,*=best', "
                f"got {rules!r}"
            )
        (rule,) = _parse_rules("--model", [pattern or _ALL])
        yield rule, model


def _parse_rules(option: str, texts: Sequence[str]) -> Iterator[_Rule]:
    for text in texts:
        found = _WITH_FRAMES.fullmatch(text)
        if found is None:
            yield _Rule(option, text, text, slice(None))
            continue
        first, last = int(found[2]), int(found[3])
        if first > last:
            raise UsageError(
                f"{option}: expected the first frame before the last, as in LKNE:{last}-{first}, "
                f"got {text!r}"
            )
        yield _Rule(option, text, found[1], slice(first, last + 1))
