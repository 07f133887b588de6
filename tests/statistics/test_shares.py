"""The simulation of unequal shares in docs/mathematics/error-rates.md."""

import sys
from pathlib import Path

import numpy as np
import pytest

from mocapbench.metrics.statistics import ALPHA, unit_means

sys.path.insert(0, str(Path(__file__).parent))
import shares

PAGE = Path(__file__).parents[2] / "docs" / "mathematics" / "error-rates.md"
MOST = ALPHA + 0.045
"""How much of the level is kept where three people have nearly all of the weight."""


@pytest.mark.parametrize("noise", [shares.normal, shares.heavy])
@pytest.mark.parametrize("correlation", shares.CORRELATIONS)
@pytest.mark.parametrize("recordings", shares.RECORDINGS)
def test_equal_means_are_told_apart_at_about_the_level_of_the_test(recordings, correlation, noise):
    found = shares.differences(recordings, correlation, noise)
    assert shares.rate(unit_means(found, np.array(recordings) / sum(recordings))) <= MOST


@pytest.mark.parametrize("recordings", [(10, 1, 1, 1, 1), (31, 2, 2, 2, 2), (10, *[1] * 11)])
def test_n_minus_1_degrees_of_freedom_are_too_many_where_shares_are_unequal(recordings):
    found = shares.differences(recordings, 0.5)
    assert shares.rate(shares.by_number(found, np.array(recordings) / sum(recordings))) > MOST


def test_units_of_equal_shares_have_n_minus_1_degrees_of_freedom():
    found, equal = shares.differences((1,) * 6, 0.5), np.full(6, 1 / 6)
    plain, general = shares.by_number(found, equal), unit_means(found, equal)
    np.testing.assert_allclose(general.p, plain.p, rtol=1e-10)


@pytest.mark.slow
def test_the_page_holds_what_the_simulation_gives():
    page = PAGE.read_text(encoding="utf-8")
    assert all(text in page for text in shares.report())
