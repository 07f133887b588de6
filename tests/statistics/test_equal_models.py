import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import equal_models


@pytest.mark.parametrize(
    ("name", "n_positions"),
    [("200 frames, a gap of 60", 2), ("600 frames, three gaps of 30", 11)],
)
def test_equal_models_are_seldom_told_apart(name, n_positions):
    n_files = 40
    found = [equal_models.rankings(each)[1] for each in equal_models.files(name, n_files)]
    assert {ranking.n_positions for ranking in found} == {n_positions}
    assert equal_models.told_apart(found) <= 0.15  # of 40, with 5 %, more in 0.3 % of runs


def test_each_held_out_gap_as_a_unit_would_tell_equal_models_apart():
    asked = equal_models.files("200 frames, a gap of 60", 20)
    assert equal_models.told_apart([equal_models.rankings(each)[0] for each in asked]) > 0.3
