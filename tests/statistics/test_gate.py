"""The simulation of the regression gate in docs/mathematics/error-rates.md."""

import sys
from pathlib import Path

import pytest
from scipy import stats

sys.path.insert(0, str(Path(__file__).parent))
import gate

PAGE = Path(__file__).parents[2] / "docs" / "mathematics" / "error-rates.md"
NOISE = gate.Scenario("even folds, some noise", 0.15, 0.05)
EXACT = gate.Scenario("repeated exactly", 0.5, 0.0)


@pytest.mark.parametrize("n_folds", gate.FOLDS)
def test_exact_repetition_gives_no_false_alarm_and_full_power(n_folds):
    assert set(gate.failing(EXACT, n_folds, 1.0).values()) == {0.0}
    assert gate.failing(EXACT, n_folds, gate.DEGRADATION)[gate.SAME.name] == 1.0


@pytest.mark.parametrize("n_folds", gate.FOLDS)
def test_false_alarms_stay_within_normal_theory(n_folds):
    theory = stats.t.sf(3.0, n_folds - 1)
    most = stats.binom.ppf(0.999, gate.N_RUNS, theory) / gate.N_RUNS
    assert gate.failing(NOISE, n_folds, 1.0)[gate.CROSS.name] <= most


@pytest.mark.slow
def test_the_page_holds_what_the_simulation_gives():
    report, page = gate.report(), PAGE.read_text(encoding="utf-8")
    assert " ".join(report.split()) in " ".join(page.split())  # the page breaks lines elsewhere
