"""Keys: SHA-256 names for what a job computes, over everything that can change the result.

The *fit key* covers the problem (its address and root seed, the function that poses it with its
arguments, data digests), the model (name, parameters, source) and the numerical libraries. The
*score key* adds the metrics, so that a changed metric scores stored predictions again without
fitting again. `source_code.digest` says which code counts, `descriptions` how values are told
apart, and `key_parts` which part of a key is new.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
from collections.abc import Callable, Iterable, Mapping
from functools import cache, partial
from typing import TYPE_CHECKING, Any

from mocapbench.benchmark.runs.descriptions import describe_value
from mocapbench.benchmark.runs.fitting import solve
from mocapbench.benchmark.runs.key_parts import LIBRARIES
from mocapbench.benchmark.runs.source_code.digest import source_digest
from mocapbench.benchmark.tasks.base import Case
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.metrics import Metric

if TYPE_CHECKING:
    from mocapbench.baselines import Model

__all__ = ["fit_contents", "key_of", "metric_contents", "score_contents", "training_contents"]

_FITTING = (
    "mocapbench.basics",
    "mocapbench.datasets",
    "mocapbench.baselines",
    "mocapbench.benchmark",
)
_SCORING = ("mocapbench.basics", "mocapbench.metrics")


def fit_contents(
    case: Case,
    seeds: Seeds,
    *,
    model: type[Model],
    parameters: Mapping[str, Any],
    digests: Mapping[str, str],
    calibration: Callable[[Any], Any] | None = None,
) -> Mapping[str, Any]:
    """Return what the fit key of one entrant's predictions on one problem covers.

    Parameters
    ----------
    case : Case
        Whose problem is posed.
    seeds : Seeds
        The problem's address, with the entrant's label, and the root seed.
    model, parameters
        The class and its full parameters.
    digests : mapping of str to str
        Digest of each recording that models see.
    calibration : callable, optional
        What calibrates the model.
    """
    return {
        "problem": [*seeds.address, seeds.root, dict(digests)],
        "posed by": _digest_problem(case),
        "training": case.training_in(seeds.fold),
        "entrant": [model.__qualname__, dict(parameters)],
        "source": [
            source_digest(model.__module__, _FITTING) + model.files_digest,
            source_digest(solve.__name__, _FITTING),
            source_digest(calibration.__module__, _FITTING) if calibration else "",
        ],
        "libraries": {name: _installed_version(name) for name in LIBRARIES},
    }


def training_contents(fitted: Mapping[str, Any], seeds: Seeds) -> Mapping[str, Any]:
    """Return what the training key of a fitted model covers, which problems share.

    The recordings that it was fitted to are compared one by one: see `Trained.suits`.

    Parameters
    ----------
    fitted : mapping of str to Any
        What the fit key of its predictions on one of the problems covers.
    seeds : Seeds
        The streams of the fit.
    """
    shared = {name: fitted[name] for name in ("entrant", "source", "libraries")}
    return {"trained by": [*seeds.address, seeds.root], **shared}


@cache  # it is that of all jobs of a case
def _digest_problem(case: Case) -> str:
    """Return the digest of what poses the problem; where cases share it, without references.

    What tells people from strangers alone has hundreds of names.
    """
    match case.problem:
        case partial(func=function, args=args, keywords=keywords) if case.shares_problem:
            shared = {name: value for name, value in keywords.items() if name != "references"}
            described = describe_value(partial(function, *args, **shared), _FITTING)
        case function:
            described = describe_value(function, _FITTING)
    return key_of(described)


@cache
def _installed_version(library: str) -> str:
    return importlib.metadata.version(library)


def metric_contents(metrics: Iterable[Metric[Any]]) -> Mapping[str, Any]:
    """Return what the score keys of all records that are scored by ``metrics`` cover of these."""
    return {metric.name: describe_value(metric.statistic, _SCORING) for metric in metrics}


def score_contents(
    fit: str, metrics: Mapping[str, Any], case: str, references: Mapping[str, str]
) -> Mapping[str, Any]:
    """Return what the score key of a record covers: the fit key, and by what it was scored.

    Parameters
    ----------
    fit : str
        The fit key.
    metrics : mapping of str to Any
        See `metric_contents`.
    case : str
        The row; others may share the fit.
    references : mapping of str to str
        Digest of each recording that only the scores depend on.
    """
    return {"fit": fit, "metrics": metrics, "scored against": [case, dict(references)]}


def key_of(contents: Any) -> str:
    """Return the key that covers ``contents``."""
    canonical = json.dumps(contents, sort_keys=True)
    return hashlib.sha256(canonical.encode()).hexdigest()
