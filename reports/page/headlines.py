"""What was found, in plain sentences: whose mean is best where, and better than the paper's models.

A model without a counterpart in the paper whose mean is better than that of one of the paper's
models is news: it is often a simple baseline that the paper lacks. Every claim says whether a
paired test finds it more than chance.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from mocapbench.metrics.statistics import ALPHA
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.base import counted, decimals, number
from mocapbench.reports.tables.contrasts import Corrected, corrected, pooled_contrast
from mocapbench.reports.tables.rank_notes import lead_note, untested_reason
from mocapbench.reports.tables.scores import case_name

__all__ = ["Finding", "Win", "lead_findings", "printed_findings", "win_findings", "wins"]


@dataclass(frozen=True)
class Finding:
    """A sentence: the subject stands out, the text says the rest."""

    subject: str
    text: str


@dataclass(frozen=True)
class Win:
    """The cases where the mean of ``winner`` is better, of the ``shared`` ones that both scored.

    ``means`` are the two entrants' means over ``cases``, the winner's first; ``overall`` is their
    contrast over all shared cases, corrected over every pair that could have been a win.
    """

    winner: str
    loser: str
    cases: tuple[CaseLayout, ...]
    shared: int
    means: tuple[float, float]
    overall: Corrected


def lead_findings(results: TaskResults, metric: str) -> list[Finding]:
    """Say whose mean is best in which cases and by how much, most cases first."""
    scored = results.judged(metric)
    champions = Counter(results.ranking(case.name, metric)[0] for case in scored)
    return [
        Finding(label, _lead(results, metric, label, scored))
        for label, _ in champions.most_common()
    ]


def _lead(results: TaskResults, metric: str, label: str, scored: Sequence[CaseLayout]) -> str:
    led = [case for case in scored if results.ranking(case.name, metric)[0] == label]
    title, where = results.metrics[metric].title, _where(led, len(scored))
    seconds = [results.ranking(case.name, metric)[1:2] for case in led]
    if not all(seconds):
        return f"is the only entrant with a score in {where} ({title})."
    own = _mean(results, metric, led, [label] * len(led))
    other = _mean(results, metric, led, [second for (second,) in seconds])
    one, two = _same_places(own, other)
    lead = f"has the best mean {title} in {where}: on average {one} there, next best {two}."
    return f"{lead} {lead_note(results, metric, label, [case.name for case in led])}"


def _where(cases: Sequence[CaseLayout], total: int) -> str:
    if len(cases) < total:
        return f"{len(cases)} of {total} cases ({', '.join(map(case_name, cases))})"
    synthetic = sum(case.synthetic for case in cases)
    every = {1: "the only case", 2: "both cases"}.get(total, f"all {total} cases")
    return every + (f" ({synthetic} synthetic)" if synthetic else "")


def _same_places(*values: float) -> list[str]:
    return [number(value, decimals(values)) for value in values]


def _mean(
    results: TaskResults, metric: str, cases: Sequence[CaseLayout], labels: Sequence[str]
) -> float:
    pairs = zip(cases, labels, strict=True)
    return float(
        np.mean([results.estimates[case.name, label, metric].mean for case, label in pairs])
    )


def wins(results: TaskResults, metric: str) -> list[Win]:
    """Return where the mean of a label without a published counterpart betters one that has one.

    Losers come in table order; for each, the winner of most cases comes first.
    """
    ours = [label for label in results.layout.ranked if label in results.layout.published_models]
    others = [label for label in results.layout.ranked if label not in ours]
    pairs = [
        (winner, loser)
        for loser in ours
        for winner in others
        if _shared(results, metric, winner, loser)
    ]
    overall = corrected([pooled_contrast(results, metric, *each) for each in pairs])
    found = [
        _win(results, metric, *each, contrast)
        for each, contrast in zip(pairs, overall, strict=True)
        if _won(results, metric, *each)
    ]
    return sorted(found, key=lambda win: (ours.index(win.loser), -len(win.cases)))


def _won(results: TaskResults, metric: str, winner: str, loser: str) -> list[CaseLayout]:
    shared = _shared(results, metric, winner, loser)
    return [case for case in shared if _beats(results, metric, case.name, winner, loser)]


def _shared(results: TaskResults, metric: str, *labels: str) -> list[CaseLayout]:
    judged = results.judged(metric)
    return [case for case in judged if set(labels) <= set(results.ranking(case.name, metric))]


def _win(results: TaskResults, metric: str, winner: str, loser: str, overall: Corrected) -> Win:
    won = _won(results, metric, winner, loser)
    n_shared = len(_shared(results, metric, winner, loser))
    one, other = (_mean(results, metric, won, [label] * len(won)) for label in (winner, loser))
    return Win(winner, loser, tuple(won), n_shared, (one, other), overall)


def _beats(results: TaskResults, metric: str, case: str, winner: str, loser: str) -> bool:
    loss = results.metrics[metric].loss
    one, other = (results.estimates[case, label, metric].mean for label in (winner, loser))
    return loss(one) < loss(other)


def win_findings(results: TaskResults, metric: str) -> list[Finding]:
    """Say, for each of the paper's models, which models that it lacks have a better mean."""
    by_loser = groupby(wins(results, metric), key=lambda win: win.loser)
    return [_defeat(results, loser, list(group)) for loser, group in by_loser]


def _defeat(results: TaskResults, loser: str, found: Sequence[Win]) -> Finding:
    first, *rest = found
    one, two = _same_places(*first.means)
    text = f"in {_where(first.cases, first.shared)}: on average {one} there against {two}."
    return Finding(
        f"{first.winner} has a better mean than {loser}",
        " ".join([text, _overall(results, first), *([f"Also, {_others(rest)}."] if rest else [])]),
    )


def _others(found: Sequence[Win]) -> str:
    """Return the winners by what their leads are, with the cases of those that lead in some."""
    by_judgement: dict[str, list[str]] = {}
    for win in found:
        some = "" if len(win.cases) == win.shared else f" ({len(win.cases)} of {win.shared})"
        by_judgement.setdefault(_judgement(win), []).append(f"{win.winner}{some}")
    return "; ".join(f"{what}: {', '.join(names)}" for what, names in by_judgement.items())


def _overall(results: TaskResults, win: Win) -> str:
    found = win.overall.contrast
    if found.n < 2:
        return f"Not tested: {untested_reason(results)}."
    low, high = _same_places(found.low, found.high)
    units = {1: f"its {found.n} folds", 2: "both cases"}.get(win.shared, f"all {win.shared} cases")
    return f"Over {units}, 95 % interval of the lead {low} to {high}: {_judgement(win)}."


def _judgement(win: Win) -> str:
    """Return whether the lead over all shared cases is more than chance."""
    if win.overall.contrast.n < 2:
        return "not tested"
    found = win.overall.contrast
    if found.advantage > 0.0 and win.overall.separable:
        return "more than chance"
    return "may be chance" if found.t_p > ALPHA else "may be chance, after Holm’s correction"


def printed_findings(results: TaskResults, metric: str) -> list[Finding]:
    """Say where the paper prints a value that no entrant of this run reaches."""
    loss = results.metrics[metric].loss
    tops = {case.name: _best_printed(results, case, metric) for case in results.cases}
    compared = [(case, top) for case, top in tops.items() if top and results.ranking(case, metric)]
    better = [
        f"{case}: {top.model} {top.value:g}"
        for case, top in compared
        if loss(top.value) < _best_loss(results, case, metric)
    ]
    where = f"in {len(better)} of {counted(len(compared), 'case')} ({'; '.join(better)})."
    return [Finding("The paper prints better values than any here", where)] if better else []


def _best_printed(results: TaskResults, case: CaseLayout, metric: str) -> PublishedValue | None:
    row = (None if case.synthetic else case.published, results.layout.published_metrics.get(metric))
    apart = {results.layout.published_models.get(label) for label in case.not_comparable}
    printed = [
        value
        for value in results.published.values()
        if (value.case, value.metric) == row
        and value.model not in apart
        and not value.not_comparable
    ]
    loss = results.metrics[metric].loss
    return min(printed, key=lambda value: loss(value.value), default=None)


def _best_loss(results: TaskResults, case: str, metric: str) -> float:
    best = results.ranking(case, metric)[0]
    return results.metrics[metric].loss(results.estimates[case, best, metric].mean)
