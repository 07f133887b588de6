"""One cell as a row of values, which `COLUMNS` names."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mocapbench.reports.analysis.failures import Failure
from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.published.comparisons import Comparison
from mocapbench.reports.bundle.origin import Origin

__all__ = ["COLUMNS", "CellScore", "Job", "Shared", "cell_row"]

COLUMNS = (
    *("case", "label", "model", "parameters", "seed", "command", "recordings", "folds", "keys"),
    *("fit_seconds", "predict_seconds", "peak_memory_mb", "failures", "scores"),
)
"""``folds`` to ``peak_memory_mb`` have one value a fold; ``keys`` are their bytes in base 64.
``scores`` has for each metric of the task its values by fold, their mean, half the 95 % interval
of the mean where there are several units, and the published value beside it where there is one."""

Job = tuple[Any, ...]
"""Fold, model, parameters, seconds to fit and to predict, megabytes."""


class Shared:
    """Values that stand once, each known by its place."""

    def __init__(self) -> None:
        self._places: dict[Hashable, int] = {}

    def place(self, value: Hashable) -> int:
        """Return the place of ``value``, the next one if it is new."""
        return self._places.setdefault(value, len(self._places))

    @property
    def values(self) -> list[Hashable]:
        """Every value, in its place."""
        return list(self._places)


@dataclass(frozen=True)
class CellScore:
    """One metric of a cell.

    Parameters
    ----------
    estimate : FoldMean
    published : Comparison or None
    values : mapping of int to float
        The finite values by fold.
    """

    estimate: FoldMean
    published: Comparison | None
    values: Mapping[int, float] = field(default_factory=dict)


def cell_row(
    cell: tuple[str, str],
    jobs: Sequence[Job],
    origin: Origin,
    failures: Sequence[Failure],
    scores: Sequence[CellScore | None],
    *,
    shared: Shared,
) -> list[Any]:
    """Return the values of one cell, a case and a label.

    Parameters
    ----------
    cell : tuple of str
    jobs : sequence of Job
        One a fold, one or more.
    origin : Origin
    failures : sequence of Failure
    scores : sequence of CellScore or None
        One for each metric of the task, None where the cell has no value of it.
    shared : Shared
        Takes what other cells may have too.
    """
    folds, models, parameters, *costs = zip(*jobs, strict=True)
    keys = _join_keys([origin.keys.get(fold, "") for fold in folds])
    return [
        *(shared.place(text) for text in (*cell, models[0], parameters[0])),
        origin.seed,
        [shared.place(piece) for piece in origin.command],
        shared.place(tuple(origin.recordings.items())),
        folds,
        b64encode(keys).decode(),
        *([_round_digits(value, 2) for value in of_folds] for of_folds in costs),
        [[t.fold, shared.place(t.status), shared.place(t.message), t.id] for t in failures],
        [score and _score(score, folds, shared) for score in scores],
    ]


def _score(score: CellScore, folds: Sequence[int], shared: Shared) -> list[Any]:
    values = [_round_digits(score.values.get(fold)) for fold in folds]
    published = [_encode_published(score.published, shared)] if score.published else []
    mean, half_width = score.estimate.mean, score.estimate.half_width
    return [values, _round_digits(mean), _round_digits(half_width), *published]


def _encode_published(pair: Comparison, shared: Shared) -> list[Any]:
    paper = pair.published
    texts = (paper.source, pair.verdict.value, pair.reason, paper.erratum)
    return [paper.value, paper.two_sd, *map(shared.place, texts)]


def _round_digits(value: float | None, digits: int = 6) -> float | None:
    """Return ``value`` with so many significant digits, None where there is no finite value."""
    if value is None or not abs(value) < float("inf"):
        return None
    rounded = float(f"{value:.{digits}g}")
    return int(rounded) if rounded.is_integer() else rounded  # shorter by ".0"


def _join_keys(keys: Sequence[str]) -> bytes:
    """Return keys of hexadecimal digits as bytes; nothing where one is not a key of a run."""
    try:
        return b"".join(map(bytes.fromhex, keys))
    except ValueError:
        return b""
