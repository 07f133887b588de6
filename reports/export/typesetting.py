"""The tables for a paper of what is chosen of a run: as numbers, in LaTeX and in Markdown."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults, task_results
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.export.latex import table_latex
from mocapbench.reports.export.markdown import table_markdown
from mocapbench.reports.export.means import tabulate_means
from mocapbench.reports.export.page_width import fit_page
from mocapbench.reports.export.paper_table import build_table
from mocapbench.reports.export.selection import order_labels, select_results
from mocapbench.reports.paper.citations import citations_of
from mocapbench.reports.tables.base import Table

__all__ = ["latex_text", "markdown_text", "paper_tables"]


def paper_tables(
    bundle: Bundle,
    tasks: Sequence[str],
    cases: Sequence[str] = (),
    labels: Sequence[str] = (),
    metrics: Sequence[str] = (),
) -> tuple[pd.DataFrame, list[Table]]:
    """Return the means of what is chosen, and tables of them.

    Parameters
    ----------
    bundle : Bundle
    tasks : sequence of str
    cases, labels, metrics : sequence of str, optional
        By default all cases, all labels, the best first, and the first metric of each task that has
        a score. What has none is left out.
    """
    chosen, means, tables = select_results(bundle, tasks, cases, labels), [], []
    for layout in chosen.layouts:
        results = task_results(chosen, layout)
        scored = {*results.scores["metric"]}
        first = [name for name in layout.page.metrics if name in scored][:1]
        shown = [name for name in metrics if name in scored] if metrics else first
        if shown:
            found = results if labels else order_labels(results, shown[0])
            means.append(tabulate_means(found, shown))
            tables += _build_tables(found, means[-1], bundle)
    return pd.concat(means, ignore_index=True) if means else pd.DataFrame(), tables


def latex_text(tables: Sequence[Table], bundle: Bundle) -> str:
    r"""Return a file for ``\input``, which says in comments what made it and which papers it names.

    Parameters
    ----------
    tables : sequence of Table
    bundle : Bundle
    """
    cited = citations_of(layout.page.reference for layout in bundle.layouts)
    about = [
        r"\usepackage{booktabs}, and \input{...} of this file, make these tables.",
        *(f"{name}: {text}" for name, text in bundle.provenance.items() if name in _MADE_BY),
        *(f"{name}: {citation}" for name, citation in cited.items()),
    ]
    comments = "\n".join(f"% {' '.join(line.split())}" for line in about)
    return "\n".join([comments, "", *map(table_latex, tables)])


def markdown_text(tables: Sequence[Table]) -> str:
    """Return the tables in Markdown, one below the other."""
    return "\n".join(map(table_markdown, tables))


_MADE_BY = ("mocapbench version", "commit", "command line", "seed")


def _build_tables(results: TaskResults, means: pd.DataFrame, bundle: Bundle) -> list[Table]:
    return fit_page(build_table(results, means, bundle.provenance.get("profile", "")))
