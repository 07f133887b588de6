"""A check for people and machines: terminal, Markdown, JUnit XML, and plain values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree

from rich.box import SIMPLE
from rich.table import Table

from mocapbench.benchmark.gate.findings import Check, Finding
from mocapbench.benchmark.gate.reference import COLUMNS
from mocapbench.benchmark.gate.rule import Verdict
from mocapbench.reports.markdown import table_lines

__all__ = ["junit", "markdown", "plain", "summary", "terminal"]

WHERE = "task, case, entrant"
SHORT = ("reference", "run", "worse by", "allowed")
NUMBERS = ("folds", *SHORT, "worst fold by")
HEADS = ("verdict", WHERE, "metric", *NUMBERS, "why")
SHOWN = 50
_QUIET = frozenset({Verdict.SAME, Verdict.SKIPPED})


def summary(check: Check) -> str:
    """Return one line: counts by verdict, and the environment with its reason."""
    counts = ", ".join(f"{count} {verdict}" for verdict, count in check.counts.items())
    reason = f" ({', '.join(check.differing)} differ)" if check.differing else ""
    return f"{counts or 'nothing to compare'}; {check.environment} environment{reason}"


def terminal(check: Check) -> Table:
    """Return what is worth a look, the gravest first, as a table of at most fifty rows.

    It is for a console that knows no markup.
    """
    groups = _notable(check)
    hidden = len(groups) - SHOWN
    more = f"{hidden} more: --markdown and --junit name them all" if hidden > 0 else None
    table = Table(box=SIMPLE, caption=more)
    for head in ("verdict", "what", *SHORT):
        table.add_column(head, overflow="fold", no_wrap=head != "what")
    for group in groups[:SHOWN]:
        cells = dict(zip(HEADS, _cells(group), strict=True))
        what = "\n".join(filter(None, (cells[WHERE], cells["metric"], cells["why"])))
        style = "bold red" if _fails(check, group[0]) else ""
        table.add_row(cells["verdict"], what, *(cells[head] for head in SHORT), style=style)
    return table


def markdown(check: Check) -> str:
    """Return a summary for a pull request."""
    state = "passed" if check.exit_code == 0 else f"failed, exit code {int(check.exit_code)}"
    lines = [f"### Metrics: {state}", "", summary(check), ""]
    rows = [_cells(group) for group in _notable(check)]
    if rows:
        lines += [*table_lines(HEADS, rows), ""]
    return "\n".join(lines)


def junit(check: Check) -> bytes:
    """Return JUnit XML: a suite per task, a test case per case, entrant and metric."""
    root = ElementTree.Element("testsuites", name="mocapbench check")
    for task in dict.fromkeys(finding.series.address.task for finding in check.findings):
        findings = [f for f in check.findings if f.series.address.task == task]
        suite = ElementTree.SubElement(root, "testsuite", name=task, tests=str(len(findings)))
        outcomes = [_add_case(suite, check, finding) for finding in findings]
        for name in ("failure", "error", "skipped"):
            attribute = name if name == "skipped" else f"{name}s"
            suite.set(attribute, str(outcomes.count(name)))
    return bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))


def plain(check: Check) -> dict[str, Any]:
    """Return the check as JSON can hold it; the report shows it."""
    return {
        "summary": summary(check),
        "passed": check.exit_code == 0,
        "findings": [
            {
                **(vars(finding.judgement) if finding.judgement else {}),
                **dict(zip(COLUMNS, finding.series.cells, strict=True)),
                "verdict": finding.verdict,
                "fails": _fails(check, finding),
                "reason": finding.reason,
            }
            for finding in check.findings
        ],
    }


def _notable(check: Check) -> list[list[Finding]]:
    """Return what to show, the gravest first; metrics without a number share a row."""
    groups: dict[object, list[Finding]] = {}
    for finding in check.findings:
        if finding.verdict not in _QUIET:
            entrant = finding.series.address
            key = finding.judgement or (entrant, finding.verdict, finding.reason)
            groups.setdefault((entrant, key), []).append(finding)
    return sorted(groups.values(), key=lambda group: tuple(Verdict).index(group[0].verdict))


def _fails(check: Check, finding: Finding) -> bool:
    return finding.verdict in check.failing | {Verdict.BROKEN}


def _cells(group: Sequence[Finding]) -> list[str]:
    finding = group[0]
    address, judgement = finding.series.address, finding.judgement
    where = f"{address.task}, {address.case}, {address.label}"
    metrics = ", ".join(member.series.metric for member in group)
    if judgement is None:
        return [finding.verdict, where, metrics, *[""] * len(NUMBERS), finding.reason]
    return [
        *(finding.verdict, where, metrics, str(judgement.n)),
        *(f"{value:.6g}" for value in (judgement.reference, judgement.run)),
        f"{judgement.change:+.3g}",
        f"{judgement.allowance:.3g}",
        f"{judgement.worst:+.3g}",
        finding.reason,
    ]


def _add_case(suite: ElementTree.Element, check: Check, finding: Finding) -> str:
    """Add one test case, and return what its outcome is called."""
    address, metric = finding.series
    case = ElementTree.SubElement(
        suite,
        "testcase",
        classname=_printable(f"{address.task}.{address.case}"),
        name=_printable(f"{address.label}: {metric or 'job'}"),
    )
    outcome = _outcome(check, finding)
    text = "; ".join(f"{k}: {v}" for k, v in zip(HEADS, _cells([finding]), strict=True) if v)
    if outcome:
        ElementTree.SubElement(case, outcome, message=_printable(text))
    else:
        ElementTree.SubElement(case, "system-out").text = _printable(text)
    return outcome


def _outcome(check: Check, finding: Finding) -> str:
    if finding.verdict is Verdict.BROKEN:
        return "error"
    if finding.verdict is Verdict.SKIPPED:
        return "skipped"
    return "failure" if _fails(check, finding) else ""


def _printable(text: str) -> str:
    """Return ``text`` without what XML cannot hold."""
    return "".join(c if c.isprintable() else " " for c in text)
