"""Keys: SHA-256 names for what a job computes, over everything that can change the result.

The *fit key* covers the problem (task definition and version, case, fold, root seed, data
digests), the model (name, parameters, source) and the numerical libraries. The *score key* adds
the metrics, so that a changed metric rescores stored predictions without refitting.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
import importlib.metadata
import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any

from mocapbench.benchmark.tasks.base import Case, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.metrics import Metric

__all__ = ["fit_key", "score_key", "source_digest"]

_MODEL_SOURCES = ("mocapbench.baselines", "mocapbench.datasets.process")
_TASK_SOURCES = (
    "mocapbench.datasets",
    "mocapbench.benchmark.problems.blending",
    "mocapbench.benchmark.problems.cluster",
    "mocapbench.benchmark.problems.impute",
    "mocapbench.benchmark.problems.masks",
    "mocapbench.benchmark.problems.base",
    "mocapbench.benchmark.problems.recover",
    "mocapbench.benchmark.tasks.seeds",
    "mocapbench.benchmark.problems.synthesise",
    "mocapbench.benchmark.tasks",
)
_SOLVING = "mocapbench.benchmark.runs.solve"
_SOLVING_SOURCES = ("mocapbench.benchmark.problems.internals",)
_LIBRARIES = ("numpy", "scipy", "scikit-learn")


def fit_key(
    task: Task,
    case: Case,
    seeds: Seeds,
    *,
    label: str,
    model: type,
    parameters: Mapping[str, Any],
    digests: Mapping[str, str],
) -> str:
    """Return the name of one entrant's predictions on one problem.

    Parameters
    ----------
    task, case, seeds
        The problem's address.
    label : str
        The entrant, whose random streams carry it.
    model, parameters
        The class and its full parameters.
    digests : mapping of str to str
        Digest of each recording that models see.
    """
    return _digest(
        {
            "task": [task.name, task.version, source_digest(type(task).__module__, _TASK_SOURCES)],
            "case": [*_question(case), dict(digests)],
            "fold": [seeds.fold, seeds.root],
            "entrant": [label, model.__qualname__, dict(parameters)],
            "source": [
                source_digest(model.__module__, _MODEL_SOURCES),
                source_digest(_SOLVING, _SOLVING_SOURCES),
            ],
            "libraries": {name: _installed_version(name) for name in _LIBRARIES},
        }
    )


def _question(case: Case) -> tuple[str, dict[str, Any]]:
    """Return what is asked: where cases share it, settings tell the judgement, not the question."""
    return case.asked, {} if case.question else dict(case.settings)


@cache
def _installed_version(library: str) -> str:
    return importlib.metadata.version(library)


def score_key(
    fit: str, metrics: Sequence[Metric[Any]], case: str, references: Mapping[str, str]
) -> str:
    """Return the name of a record: the fit key, and by what it was scored.

    Parameters
    ----------
    fit : str
        The fit key.
    metrics : sequence of Metric
    case : str
        The row; others may share the fit.
    references : mapping of str to str
        Digest of each recording that only the scores depend on.
    """
    scored = {metric.name: _description(metric.statistic) for metric in metrics}
    return _digest({"fit": fit, "metrics": scored, "judged": [case, dict(references)]})


def _description(statistic: Callable[..., Any]) -> list[str]:
    """Name a function, the arguments that are bound to it, and the source of both."""
    match statistic:
        case partial():
            bound = [
                part
                for name, value in sorted(statistic.keywords.items())
                for part in (name, *(_description(value) if callable(value) else [repr(value)]))
            ]
            return [*_description(statistic.func), *bound]
        case _:
            source = source_digest(statistic.__module__, ("mocapbench.metrics",))
            return [statistic.__qualname__, source]


def _digest(document: Mapping[str, Any]) -> str:
    canonical = json.dumps(document, sort_keys=True)
    return hashlib.sha256(canonical.encode()).hexdigest()


@cache
def source_digest(module: str, within: tuple[str, ...]) -> str:
    """Return the digest of a module's source and of what it imports from ``within``.

    Imports are followed to the module that defines the imported name, so that a package's
    ``__init__`` does not drag its whole content in. Modules in the same folder count too: they
    are the helpers of a user's own model.

    Parameters
    ----------
    module : str
        Full name of an imported module.
    within : tuple of str
        Packages or modules whose source counts.
    """
    found: set[str] = set()
    pending = [module]
    while pending:
        name = pending.pop()
        if name not in found:
            found.add(name)
            pending += [item for item in _imports(name) if _counts(item, within, module)]
    message = "".join(f"{name}\0{_source(name)}\0" for name in sorted(found))
    return hashlib.sha256(message.encode()).hexdigest()


def _counts(module: str, within: tuple[str, ...], root: str) -> bool:
    if any(module == name or module.startswith(f"{name}.") for name in within):
        return True
    file, home = _file(module), _file(root)
    foreign = not root.startswith("mocapbench.")
    return foreign and file is not None and home is not None and file.parent == home.parent


def _file(module: str) -> Path | None:
    name = getattr(sys.modules.get(module), "__file__", None)
    return Path(name) if name else None


def _source(module: str) -> str:
    importlib.import_module(module)
    file = _file(module)
    return file.read_text(encoding="utf-8") if file else ""


def _imports(module: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(_source(module))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from (_definer(node.module, alias.name) for alias in node.names)


def _definer(package: str, name: str) -> str:
    """Return the module that defines ``name``, which ``package`` may only pass on."""
    if f"{package}.{name}" in sys.modules:
        return f"{package}.{name}"
    value = getattr(sys.modules.get(package), name, None)
    return str(getattr(value, "__module__", package))
