"""STUB, replaced at the merge."""
from __future__ import annotations
from dataclasses import dataclass
from enum import Enum
import math
from collections.abc import Sequence
import numpy as np
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
__all__ = ["Standing", "StandingKind", "standings"]
class StandingKind(Enum):
    BEST = "best"
    INSEPARABLE = "may be chance"
    BEHIND = "behind"
    UNTESTED = "too few to test"
    INCOMPLETE = "incomplete"
@dataclass(frozen=True)
class Standing:
    label: str
    mean: float
    n_cases: int
    n_units: int
    complete: bool
    difference: float
    low: float
    high: float
    standing: StandingKind
def standings(results: TaskResults, metric: str, cases: Sequence[CaseLayout] | None = None) -> tuple[Standing, ...]:
    cases = results.representative_cases(metric) if cases is None else cases
    loss = results.metrics[metric].loss
    means = {}
    for label in results.layout.ranked:
        e = [results.estimate(c.name, label, metric) for c in cases]
        e = [x.mean for x in e if x]
        if e: means[label] = (float(np.mean(e)), len(e))
    order = sorted(means, key=lambda l: (means[l][1] < len(cases), loss(means[l][0])))
    out = []
    for l in order:
        m, n = means[l]
        best = means[order[0]][0]
        kind = StandingKind.BEST if l == order[0] else (StandingKind.UNTESTED if n == len(cases) else StandingKind.INCOMPLETE)
        out.append(Standing(l, m, n, len(cases), n == len(cases), loss(m) - loss(best), math.nan, math.nan, kind))
    return tuple(out)
