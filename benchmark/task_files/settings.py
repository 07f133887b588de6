"""What a task file may say besides what it hides, and what that means."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import PurePath
from typing import Any

from mocapbench.benchmark.errors import UnregisteredNameError
from mocapbench.benchmark.registry import METRICS, MODELS, NAME, TASKS, Registry
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.selection import select_part
from mocapbench.benchmark.task_files.values import (
    is_count,
    is_positive,
    is_text,
    read_channels,
    read_names,
    read_patterns,
    read_spans,
)
from mocapbench.datasets import Recording
from mocapbench.metrics import Imputation

__all__ = ["KEYS", "NONE", "OTHERS", "Settings", "read_settings"]

NONE, OTHERS = "none", "others"
KEYS = (
    *("name", "title", "description", "files", "training", "rate", "frames", "channels"),
    *("folds", "models", "metrics", "hide"),
)
_METRICS = ("mse", "smse", "crps", "coverage_95")


@dataclass(frozen=True)
class Settings:
    """What a task file says besides what it hides.

    Parameters
    ----------
    name, title, description : str
        Of the task.
    files : tuple of str
        Patterns of the recordings to fill.
    training : tuple of str
        Patterns of the recordings that models learn from besides; or ``others`` or ``none`` alone.
    rate : float or None
        Frames per second, in place of what files say.
    select : callable
        Returns what is taken of a recording.
    folds : int
    models : tuple of str
        Names; none stands for every model that can.
    metrics : tuple of str
    """

    name: str
    title: str
    description: str
    files: tuple[str, ...]
    training: tuple[str, ...]
    rate: float | None
    select: Callable[[Recording], Recording]
    folds: int
    models: tuple[str, ...]
    metrics: tuple[str, ...]


def read_settings(document: Document) -> Settings:
    """Return what a document says besides what it hides.

    Raises
    ------
    TaskFileError
        At the first key that is not as expected.
    """
    document.require_known("", KEYS)
    name = _name(document)
    (frames,) = _one_span(document)
    rate = document.read("rate", None, is_positive, "frames per second", "120.0")
    return Settings(
        name=name,
        title=document.read("title", name, is_text, "a text", '"Gaps in our walks"'),
        description=document.read("description", "", is_text, "a text", '"Fill gaps of 0.5 s."'),
        files=_files(document),
        training=read_patterns(document, "training", [OTHERS]),
        rate=None if rate is None else float(rate),
        select=partial(select_part, frames=frames, channels=read_channels(document, "channels")),
        folds=document.read("folds", 1, is_count, "a whole number from 1 to 10,000", "5"),
        models=_read_registered(document, "models", MODELS, '["linear", "knn"]'),
        metrics=_metrics(document),
    )


def _name(document: Document) -> str:
    """Return the task's name: that of the file, unless the file says another."""
    name = document.read("name", PurePath(document.file).stem, is_text, "a text", '"our-walks"')
    if not NAME.fullmatch(name):
        expected = "letters, digits, dots, hyphens and underscores"
        raise document.error("name", expected, repr(name), 'write for example name = "our-walks"')
    if TASKS.is_installed(name):
        advice = 'write for example name = "our-walks"'
        raise document.error("name", "a name that no other task has", repr(name), advice)
    return name


def _files(document: Document) -> tuple[str, ...]:
    if document.get("files") is None:
        advice = 'write for example files = ["*.csv"]'
        raise document.error("files", "the recordings to fill", "none", advice)
    return read_patterns(document, "files", [])


def _one_span(document: Document) -> Any:
    spans = read_spans(document, "frames", [":"])
    if len(spans) > 1:
        advice = 'write for example frames = "0:600"'
        raise document.error("frames", "one span of frames", f"{len(spans)}", advice)
    return spans


def _read_registered(
    document: Document, key: str, registry: Registry[Any], example: str
) -> tuple[str, ...]:
    names = read_names(document, key, example)
    for name in names:
        try:
            registry.get(name)
        except UnregisteredNameError as error:
            near = error.args[0].partition(": ")[2]
            advice = f"{near} `mocapbench list {key}` has them all; --plugin adds yours"
            raise document.error(key, f"names of {key}", repr(name), advice) from error
    return names


def _metrics(document: Document) -> tuple[str, ...]:
    names = _read_registered(document, "metrics", METRICS, '["mse", "smse"]') or _METRICS
    of = {name: METRICS.get(name).outcome for name in names}
    for name, outcome in of.items():
        if outcome is not Imputation:
            fitting = (n for n in METRICS.names() if METRICS.get(n).outcome is Imputation)
            got = f"{name!r}, of {outcome.__name__.lower()}"
            advice = f"choose from {', '.join(fitting)}"
            raise document.error("metrics", "metrics of imputation", got, advice)
    return names
