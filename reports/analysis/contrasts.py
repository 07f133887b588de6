"""Paired contrasts of two entrants over the cases of a task, with Holm's correction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.metrics.statistics import ALPHA, Contrast, contrast, holm, pair, pooled_units
from mocapbench.reports.analysis.results import TaskResults

__all__ = ["CorrectedContrast", "corrected_contrasts", "pooled_contrast"]


@dataclass(frozen=True)
class CorrectedContrast:
    """A contrast and the p-value of its paired t-test, corrected over a family of contrasts."""

    contrast: Contrast
    p: float

    @property
    def separable(self) -> bool:
        """Whether the difference is more than chance; never without a test."""
        return self.p <= ALPHA


def corrected_contrasts(contrasts: Sequence[Contrast]) -> list[CorrectedContrast]:
    """Correct a family of contrasts by Holm's method."""
    p_values = holm([contrast.t_p for contrast in contrasts])
    return [
        CorrectedContrast(contrast, float(p))
        for contrast, p in zip(contrasts, p_values, strict=True)
    ]


def pooled_contrast(results: TaskResults, metric: str, first: str, second: str) -> Contrast:
    """Return the contrast of two labels over the representative cases.

    See Also
    --------
    mocapbench.metrics.statistics.pooled_units : what counts as one unit.
    """
    values = results.representative_values[metric]
    units = pooled_units(
        pair(values[first], values[second]), independent=results.layout.independent_folds
    )
    return contrast(units, results.metrics[metric].loss)
