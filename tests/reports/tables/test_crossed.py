import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.page.sections import task_section

PAIRS = ("12(1) vs 12(1)", "12(1) vs 16(15)", "16(15) vs 16(15)", "16(15) vs 10(5)")


@pytest.fixture
def view(small):
    values = {pair: {"replay": [26.0 + place]} for place, pair in enumerate(PAIRS)}
    values[PAIRS[3]] = {"replay": [float("nan")]}
    bundle = small(
        values,
        task="control-similarity",
        cases=tuple(
            CaseLayout(pair, dict(zip("ab", pair.split(" vs "), strict=True))) for pair in PAIRS
        ),
        crossed=("a", "b"),
        published_rows={pair: pair for pair in PAIRS},
        published_models={"replay": "real"},
        published_metrics={"mse": "MCC"},
    )
    return task_section(
        task_results(bundle, bundle.layouts[0]), bundle, model_styles(bundle.layouts)
    )


def test_pairs_are_cells_of_rows_and_columns(view):
    ((_, table),) = view["metrics"]
    assert [cell.text for cell in table.columns] == ["a", "12(1)", "16(15)", "10(5)"]
    assert [[cell.text for cell in row] for row in table.rows] == [
        ["12(1)", "26.00", "27.00", "–"],
        ["16(15)", "–", "28.00", "missing"],
    ]


def test_the_published_value_stands_below_and_its_erratum_among_the_notes(view):
    ((_, table),) = view["metrics"]
    assert table.rows[0][1].note == "26.43 (a)"
    assert table.rows[0][2].note == "20.55"
    assert any(note.startswith("a: ") and "26.249" in note for note in view["notes"])
