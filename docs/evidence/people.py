"""What many people answer, and whether half of them answer the same.

::

    python docs/evidence/people.py RUN... [--all]
    python docs/evidence/people.py RUN... --models LABEL... --beside LABEL

The first prints a row for each case of the runs that the first screen of a report answers, or for
all cases of many people: the best model and its mean, by how much it is better than the next, over
how many people, by how much it is among people with odd and with even subject numbers, and who is
best there if another; last whether the lead is decided at 5 % after Holm's correction, over rivals
and then over rows. Below is how many leads there are in both halves.

The second prints a row for each model in each case of many people: its error, by how much another
model errs more, both with 95 % intervals over people, and how much its own intervals hold.
"""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench import benchmark as bench
from mocapbench.metrics.statistics import ALPHA, holm, mean_interval
from mocapbench.reports import CaseLayout
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults, task_results
from mocapbench.reports.analysis.standings import next_best, standings
from mocapbench.reports.markdown import markup_lines
from mocapbench.reports.text import number

HALVES = {"odd": 1, "even": 0}


def main() -> None:
    """Print a table of one run or more."""
    parser = ArgumentParser()
    parser.add_argument("runs", nargs="+", type=Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--models", nargs="+", default=())
    parser.add_argument("--beside", default="makima")
    given = parser.parse_args()
    if given.models:
        rows = (row for run in given.runs for row in list_errors(run, given.models, given.beside))
        table = pd.DataFrame(rows)
        print("\n".join(markup_lines([*table.columns], table.to_numpy().tolist())))
    else:
        print_leads(given.runs, whole=given.all)


def print_leads(runs: Sequence[Path], *, whole: bool) -> None:
    """Print who leads in each case, and how many leads are in both halves."""
    table = pd.DataFrame(row for run in runs for row in list_leads(run, whole=whole))
    table["decided"] = np.where(holm(table.pop("p")) <= ALPHA, "yes", "no")
    agree = table.pop("agrees")
    print("\n".join(markup_lines([*table.columns], table.to_numpy().tolist())))
    print(
        f"\n{len(table)} leads, {(table['decided'] == 'yes').sum()} decided; the same way in both "
        f"halves: {agree.sum()}, of the decided {(agree & (table['decided'] == 'yes')).sum()}"
    )


def list_errors(run: Path, models: Sequence[str], beside: str) -> Iterator[dict[str, str]]:
    """Yield a row for each model that has a score in a case of many people."""
    for results in load_results(run):
        for case in find_cases(results, whole=True):
            found = cells(results, results.layout.page.metrics[0], [case])
            for label in [label for label in models if label in found.labels]:
                held = results.estimate(case.name, label, "coverage_95")
                yield {
                    "task": f"`{results.layout.name}`",
                    "case": case.name,
                    "model": f"`{label}`",
                    **describe_errors(found, label, beside),
                    "coverage": number(held.mean, 3) if held else "",
                }


def describe_errors(found: Cells, label: str, beside: str) -> dict[str, str]:
    """Return the error of a model, by how much another errs more, and over how many people."""
    rows = [found.labels.index(name) for name in (label, beside)]
    kept = np.asarray(found.scored[rows].all(axis=0))
    ours, theirs = found.by_unit(found.values[rows], kept)
    return {
        "error": describe_interval(ours),
        f"`{beside}`, more": describe_interval(theirs - ours),
        "people": str(len(ours)),
    }


def describe_interval(values: NDArray[np.float64]) -> str:
    """Return a mean over people and half of its 95 % interval."""
    low, high = mean_interval(values)
    return f"{values.mean():.2f} ± {(high - low) / 2:.2f}"


def load_results(run: Path) -> Iterator[TaskResults]:
    """Yield the results of the tasks of a run."""
    store = bench.RunDirectory(run)
    bundle = bench.bundle(store.planned(), store.load_plan()["provenance"])
    yield from (task_results(bundle, layout) for layout in bundle.layouts)


def list_leads(run: Path, *, whole: bool) -> Iterator[dict[str, object]]:
    """Yield a row for each case in which a model leads."""
    for results in load_results(run):
        for case in find_cases(results, whole):
            found = standings(results, results.layout.page.metrics[0], [case])
            second = next_best(found)
            if second:
                yield describe_lead(results, case, found[0].label, second.label)


def find_cases(results: TaskResults, whole: bool) -> Iterator[CaseLayout]:
    """Yield the cases that the first screen answers, or all whose folds are of many people."""
    for case in results.representative_cases(results.layout.page.metrics[0]):
        if case.name in results.layout.page.asks or (whole and case.subjects):
            yield case


def compare(results: TaskResults, case: CaseLayout, one: str, other: str) -> PairContrast:
    """Return by how much one model is better than another in a case."""
    return contrasts(cells(results, results.layout.page.metrics[0], [case]))[one, other]


def describe_lead(
    results: TaskResults, case: CaseLayout, best: str, second: str
) -> dict[str, object]:
    """Return a row: the lead over all people, and the same in each half of them."""
    lead = compare(results, case, best, second)
    row = {
        "task": f"`{results.layout.name}`",
        "case": case.name,
        "best": f"`{best}` {number(lead.first, 2)}",
        "next": f"`{second}`",
        "better by": " to ".join(number(end, 2) for end in (lead.low, lead.high)),
        "people": str(lead.n),
        "p": lead.t_p_holm,
        "agrees": True,
    }
    for name, remainder in HALVES.items():
        half = keep_people(results, case, remainder)
        leader = standings(half, results.layout.page.metrics[0], [case])[0].label
        within = compare(half, case, best, second).advantage
        row[name] = number(within, 2) + ("" if leader == best else f", `{leader}` best")
        row["agrees"] = bool(row["agrees"]) and leader == best
    return row


def keep_people(results: TaskResults, case: CaseLayout, remainder: int) -> TaskResults:
    """Return the results of people whose number, divided by two, leaves ``remainder``."""
    kept = [fold for fold in results.fold_numbers if int(case.subject(fold)) % 2 == remainder]
    return replace(results, folds=results.folds[kept])


if __name__ == "__main__":
    main()
