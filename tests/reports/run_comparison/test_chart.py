"""Slope charts show the scores that they are given, and name none twice at one height."""

import math
import re
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.run_comparison.chart import BOTTOM, GAP, TOP, slope_chart
from mocapbench.reports.run_comparison.values import ChangeVerdict, ScoreChange

VALUES = st.floats(-1e3, 1e3).filter(lambda value: value == 0.0 or abs(value) > 1e-6)


def score(case, first, second, verdict=ChangeVerdict.WORSE):
    return ScoreChange("t", case, "knn", "mse", 3, first, second, math.nan, math.nan, verdict)


def lines(svg):
    found = re.findall(r'<path class="([a-z-]+)" d="M70 ([\d.]+)L250 ([\d.]+)">', svg)
    return [(kind, float(first), float(second)) for kind, first, second in found]


@given(st.lists(st.tuples(VALUES, VALUES), min_size=1, max_size=30))
def test_greater_is_higher_and_all_lines_are_within_the_chart(pairs):
    scores = [score(f"case {n}", *pair) for n, pair in enumerate(pairs)]
    drawn = lines(slope_chart("Title", ("a", "b"), scores))
    assert len(drawn) == len(scores)
    heights = {
        value: at
        for pair, line in zip(pairs, drawn, strict=True)
        for value, at in zip(pair, line[1:], strict=True)
    }
    ordered = [heights[value] for value in sorted(heights)]
    assert ordered == sorted(ordered, reverse=True)
    assert min(ordered) >= TOP
    assert max(ordered) <= BOTTOM


@given(st.lists(st.tuples(VALUES, VALUES), min_size=1, max_size=40))
def test_no_name_lies_on_another(pairs):
    svg = slope_chart("Title", ("a", "b"), [score(f"c{n}", *pair) for n, pair in enumerate(pairs)])
    heights = sorted(float(y) for y in re.findall(r'x="258" y="([-\d.]+)"', svg))
    assert all(after - before > GAP - 0.11 for before, after in pairwise(heights))


def test_a_scale_is_logarithmic_where_scores_span_a_factor_of_ten():
    scores = [score(str(n), 10.0**n, 10.0**n) for n in range(3)]
    (_, low, _), (_, middle, _), (_, high, _) = lines(slope_chart("Title", ("a", "b"), scores))
    assert middle == (low + high) / 2


def test_names_are_text_and_nothing_else():
    svg = slope_chart("<Title>", ("<a>", "b"), [score("<case>", 1.0, 2.0)])
    assert "&lt;Title&gt;" in svg
    assert "&lt;case&gt;" in svg
    assert "<case>" not in svg
