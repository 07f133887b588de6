"""Scores of an answer by every metric; one that fails costs no other metric its score."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.benchmark.messages import reason, traceback_of
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.score_values import fault_of_score
from mocapbench.metrics import Metric, Score

__all__ = ["Scoring", "scoring"]


@dataclass(frozen=True)
class Scoring:
    """What the metrics of a job made of an answer.

    Parameters
    ----------
    scores : mapping of str to Score
        By the names of the metrics that are defined for the answer.
    errors : mapping of str to Exception
        Why metrics failed, by their names.
    """

    scores: Mapping[str, Score]
    errors: Mapping[str, Exception]

    @property
    def status(self) -> Status:
        """How the job ended: it failed if a metric did."""
        return Status.FAILED if self.errors else Status.OK

    @property
    def message(self) -> str:
        """Why metrics failed, and whether there are scores all the same; empty if none failed."""
        reasons = "; ".join(map(reason, self.errors.values()))
        kept = f" ({format_count(len(self.scores), 'other score')} kept)" if self.scores else ""
        return f"{reasons}{kept}" if reasons else ""

    @property
    def results(self) -> dict[str, Any]:
        """What a record keeps of it."""
        scores = self.scores.items()
        return {
            "traceback": "\n".join(map(traceback_of, self.errors.values())),
            "scores": {name: float(score.value) for name, score in scores},
            "parts": {
                name: {axis: values.tolist() for axis, values in score.parts.items()}
                for name, score in scores
            },
            "left_out": {name: score.left_out for name, score in scores if score.left_out},
        }


def scoring(job: Job, problem: Problem[Any], fit: Fit) -> Scoring:
    """Score the answer of ``fit`` by every metric of a job that is defined for it.

    Raises
    ------
    MemoryError
        If a metric needs more memory than there is.
    ValueError
        If no metric is defined for the answer.
    """
    outcome = problem.outcome(problem.answer_type.from_arrays(fit.arrays))
    scores: dict[str, Score] = {}
    errors: dict[str, Exception] = {}
    for name in job.metrics:
        try:
            scores |= _scored_by(METRICS.get(name), outcome)
        except MemoryError:  # for `Job.failed`, which says what to do
            raise
        except Exception as error:
            errors[name] = error
    if not scores and not errors:
        raise ValueError(
            f"none of the metrics {', '.join(job.metrics)} is defined for the answer of "
            f"{job.address.label} to {job.address.task}; choose others with --metrics"
        )
    return Scoring(scores, errors)


def _scored_by(metric: Metric[Any], outcome: object) -> dict[str, Score]:
    """Return the score by the metric's name, or nothing where the metric is not defined."""
    overflows: list[str] = []
    try:
        if not metric.applies(outcome):
            return {}
        with np.errstate(over="call", call=lambda kind, _: overflows.append(kind)):
            score: object = metric(outcome)
    except MemoryError:
        raise
    except BaseException as error:
        raise RuntimeError(f"the metric {metric.name!r} raised {reason(error)}") from error
    fault = fault_of_score(score)
    if fault:
        raise ValueError(f"expected the metric {metric.name!r} {fault}")
    assert isinstance(score, Score)
    _require_finite(metric.name, float(score.value), bool(overflows))
    return {metric.name: score}


def _require_finite(name: str, value: float, overflowed: bool) -> None:
    """Refuse a value that is infinite, or NaN because numbers on the way to it overflowed.

    Any other NaN says that the metric is not defined for this answer.
    """
    if math.isinf(value) or (math.isnan(value) and overflowed):
        why = ": numbers overflowed" if overflowed else ""
        raise ValueError(f"{name} is {value}{why}; expected a finite score, or NaN for undefined")
