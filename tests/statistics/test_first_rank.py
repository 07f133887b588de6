"""The simulation of the first rank in docs/mathematics/error-rates.md."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
import first_rank

PAGE = Path(__file__).parents[2] / "docs" / "mathematics" / "error-rates.md"


def test_two_equal_entrants_are_separated_at_the_nominal_rate():
    rows, entrants = first_rank.left_out(5, 2)
    assert rows == entrants == pytest.approx(0.05, abs=3.0 * (0.05 * 0.95 / 1000) ** 0.5)


@pytest.mark.slow
def test_the_page_holds_what_the_simulation_gives():
    assert first_rank.report() in PAGE.read_text(encoding="utf-8")
