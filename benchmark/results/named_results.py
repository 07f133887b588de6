"""What a user names of a run: its tasks, cases, models and metrics, as its tables call them."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.runs.request import matching_cases, split_cases
from mocapbench.reports import Bundle

__all__ = ["find_cases", "find_labels", "find_metrics", "find_tasks"]


def find_tasks(bundle: Bundle, names: Sequence[str]) -> tuple[str, ...]:
    """Return the tasks that are named, by default all.

    Raises
    ------
    UnknownNameError
        If the run has none of that name, as for the functions below.
    """
    known = [layout.name for layout in bundle.layouts]
    _require_known("task", names, known)
    return tuple(dict.fromkeys(names or known))


def find_cases(bundle: Bundle, texts: Sequence[str]) -> tuple[str, ...]:
    """Return the cases that texts name, by patterns and beginnings too; none for all."""
    known = [*dict.fromkeys(bundle.records["case"])]
    wanted = [name for text in texts for name in split_cases(text, known)]
    found = {name: matching_cases(name, known) for name in wanted}
    _require_known("case", [name for name in wanted if not found[name]], known)
    return tuple(dict.fromkeys(case for name in wanted for case in found[name]))


def find_labels(bundle: Bundle, names: Sequence[str]) -> tuple[str, ...]:
    """Return the labels that are named, be it by their model; none for all."""
    pairs = bundle.records[["label", "model"]].drop_duplicates()
    labels = [*dict.fromkeys(pairs["label"])]
    by_model = pairs.groupby("model", sort=False)["label"].agg(list).to_dict()
    _require_known("model", names, [*dict.fromkeys([*labels, *by_model])])
    found = ([name] if name in labels else by_model[name] for name in names)
    return tuple(dict.fromkeys(label for several in found for label in several))


def find_metrics(bundle: Bundle, names: Sequence[str]) -> tuple[str, ...]:
    """Return the metrics that are named; none for the first of each task."""
    _require_known("metric", names, [*dict.fromkeys(bundle.scores["metric"])])
    return tuple(dict.fromkeys(names))


def _require_known(kind: str, names: Sequence[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise UnknownNameError(f"{kind} of this run", name, known)
