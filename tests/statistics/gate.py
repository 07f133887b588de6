"""False alarms and power of the regression gate: `python gate.py [PAGE]`.

A simulated run is n paired folds. Fold i has the value exp(s a_i + u b_i / √2) in the reference and
f exp(s a_i + u c_i / √2) in the run, with a, b, c standard normal. s is the variation between
folds, u the variation that pairing does not cancel, and f is 1 for an equally good run. s and u are
the standard deviations that `noise.py` measures.

Prints the tables, and writes them into the page if one is given.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import stats

from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.rule import DEFAULT_TOLERANCES, FAILING, Tolerance, Verdict, judge

sys.path.insert(0, str(Path(__file__).parents[1] / "speed"))
from page import place, table

__all__ = ["CROSS", "SAME", "Gate", "Scenario", "failing"]

SEED = 20_240_601
N_RUNS = 1_000
FOLDS = (5, 12)
DEGRADATION = 1.1


@dataclass(frozen=True)
class Scenario:
    """Standard deviations of log values over folds: of difficulty, and of what is not paired."""

    name: str
    uneven: float
    unpaired: float


@dataclass(frozen=True)
class Gate:
    """A tolerance of changes, and the verdicts that fail."""

    name: str
    tolerance: Tolerance
    failing: frozenset[Verdict]


SAME, CROSS = (Gate(e.value, DEFAULT_TOLERANCES[e], FAILING[e]) for e in Environment)
GATES = (SAME, CROSS, Gate("cross, k = 2", Tolerance(k=2.0, relative=0.02), CROSS.failing))
SCENARIOS = (
    Scenario("repeated exactly", 0.5, 0.0),
    Scenario("other rounding", 0.5, 0.01),
    Scenario("another algorithm", 0.5, 0.2),
    Scenario("other seeds: nothing is paired", 0.0, 0.5 * math.sqrt(2.0)),
)


def failing(scenario: Scenario, n_folds: int, factor: float) -> Mapping[str, float]:
    """Return, by gate, the share of simulated runs that it fails.

    Parameters
    ----------
    scenario : Scenario
    n_folds : int
    factor : float
        Factor of every value of the run.
    """
    rng = np.random.default_rng([SEED, n_folds])
    a, b, c = rng.standard_normal((3, N_RUNS, n_folds))
    s, u = scenario.uneven, scenario.unpaired / math.sqrt(2.0)
    reference, run = np.exp(s * a + u * b), factor * np.exp(s * a + u * c)
    pairs = list(zip(reference.tolist(), run.tolist(), strict=True))
    return {
        gate.name: np.mean(
            [judge(*pair, float, gate.tolerance).verdict in gate.failing for pair in pairs]
        )
        for gate in GATES
    }


def rows() -> Iterator[list[str]]:
    """Yield one row per scenario and number of folds."""
    for scenario in SCENARIOS:
        noise = [f"{each:.2f}" for each in (scenario.uneven, scenario.unpaired)]
        for n_folds in FOLDS:
            good, worse = (failing(scenario, n_folds, factor) for factor in (1.0, DEGRADATION))
            percent = (f"{100 * good[g.name]:.1f}, {100 * worse[g.name]:.1f} %" for g in GATES)
            yield [scenario.name, *noise, str(n_folds), *percent]


def report() -> str:
    """Return the table of false alarms and power."""
    head = ["what differs", "s", "u", "folds", *(gate.name for gate in GATES)]
    tails = " and ".join(f"{100.0 * stats.t.sf(3.0, n - 1):.2f} % at {n} folds" for n in FOLDS)
    return (
        f"Of {N_RUNS} runs that are as good, and of {N_RUNS} that are 10 % worse, those that fail. "
        f"Normal theory gives false alarms of {tails}, for k = 3 without a floor.\n\n"
        f"{table(head, rows())}"
    )


if __name__ == "__main__":
    text = report()
    print(text)
    for page in sys.argv[1:]:
        place(Path(page), "gate", text)
