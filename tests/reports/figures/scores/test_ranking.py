"""The figure of a ranking: its rows are the standings, its dots the means."""

from xml.etree import ElementTree

import numpy as np
import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.figures.scores.ranking import ranking
from mocapbench.reports.figures.styles import model_styles

SPREAD = (0.9, 1.0, 1.1)
MEANS = {"oracle": 0.5, "nn": 3.0, "knn": 1.0, "linear": 2.0}


@pytest.fixture
def drawn(small):
    """Return a function that draws the ranking of values by case and label."""

    def drawn(values):
        bundle = small(values)
        results = task_results(bundle, bundle.layouts[0])
        return ranking(results, results.layout.page.metrics[0], model_styles(bundle.layouts))

    return drawn


def _values(cases, labels):
    return {
        f"case {number}": {
            label: [(1 + number) * MEANS[label] * share for share in SPREAD] for label in labels
        }
        for number in range(cases)
    }


def _rows(figure):
    rows = [g for g in ElementTree.fromstring(figure.svg).iter() if "data-model" in g.attrib]
    return {row.attrib["data-model"]: row for row in rows}


@pytest.mark.parametrize("cases", [1, 3])
def test_the_best_is_on_top_and_references_are_below(drawn, cases):
    figure = drawn(_values(cases, MEANS))
    assert [*_rows(figure)] == ["knn", "linear", "nn", "oracle"]
    assert ("tick" in figure.caption) == (cases > 1)


def test_rows_say_the_mean_over_cases(drawn):
    rows = _rows(drawn(_values(3, MEANS)))
    for label, row in rows.items():
        told = next(part.text for part in row.iter() if part.tag.endswith("title"))
        assert told == f"{label}: {np.mean([1, 2, 3]) * MEANS[label]:.4g}, 3 cases"


def test_one_model_is_no_ranking(drawn):
    assert drawn(_values(2, ["knn"])) is None
