import numpy as np
import pytest

from mocapbench.reports.analysis.contrasts import corrected_contrasts, pooled_contrast
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.tables.contrasts import contrast_table

VALUES = {
    f"row {number}": {"a": [0.1 * number], "b": [0.5 + 0.101 * number], "c": [0.11 * number]}
    for number in range(1, 6)
}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def cell(table, one, other):
    row = next(row for row in table.rows if row[0].text == one)
    return row[[column.text for column in table.columns].index(f"than {other}")]


def test_the_matrix_shows_the_difference_its_interval_and_the_probabilities(small):
    table = contrast_table(results_of(small(VALUES)), "mse")
    found = cell(table, "a", "b")
    assert (found.text, found.kind) == ("0.50", "contrast ahead")
    assert found.note.replace("\N{NO-BREAK SPACE}", " ") == "0.50 to 0.50; 100% / 0% / 0%"
    assert cell(table, "a", "a").kind == "absent"


def test_the_matrix_is_antisymmetric(small):
    table = contrast_table(results_of(small(VALUES)), "mse")
    there, back = cell(table, "a", "b"), cell(table, "b", "a")
    assert (back.text, back.kind) == (f"−{there.text}", "contrast behind")
    assert back.note.replace("\N{NO-BREAK SPACE}", " ") == "−0.50 to −0.50; 0% / 0% / 100%"


def test_a_mark_stands_only_where_the_test_separates(small):
    values = {case: {**labels, "d": [labels["a"][0]]} for case, labels in VALUES.items()}
    table = contrast_table(results_of(small(values)), "mse")
    assert cell(table, "a", "d").kind == "contrast"
    assert cell(table, "a", "d").text == "0.000"


def test_the_data_hold_every_pair_once_at_full_precision(small):
    results = results_of(small(VALUES))
    data = contrast_table(results, "mse").data
    assert len(data) == 3
    assert data["advantage"].iloc[0] == pooled_contrast(results, "mse", "a", "b").advantage
    assert (data["t_p_holm"] >= data["t_p"]).all()


def test_few_units_say_that_signed_ranks_are_powerless(small):
    notes = contrast_table(results_of(small(VALUES)), "mse").notes
    assert "over 5 cases, each the mean of its folds" in notes[0]
    assert "cannot go below p = 0.0625 with 5 units" in notes[-1]


def test_a_lone_case_is_contrasted_over_its_folds(small):
    values = {"row": {"a": [1.0, 1.1, 0.9], "b": [2.0, 2.2, 2.1]}}
    assert "3 folds of the only case" in contrast_table(results_of(small(values)), "mse").notes[0]


@pytest.mark.parametrize("independent", [True, False])
def test_one_unit_is_no_matrix(small, independent):
    values = {
        "row": {"a": [1.0] * (1 if independent else 4), "b": [2.0] * (1 if independent else 4)}
    }
    bundle = small(values, independent_folds=independent)
    assert contrast_table(results_of(bundle), "mse") is None


def test_a_lone_entrant_and_the_oracle_are_not_contrasted(small):
    bundle = small({"x": {"a": [1.0], "oracle": [0.5]}, "y": {"a": [1.0], "oracle": [0.5]}})
    assert contrast_table(results_of(bundle), "mse") is None


def test_generated_motion_is_left_out_beside_recordings(small):
    cases = (
        CaseLayout("row 1", {}, synthetic=True),
        *(CaseLayout(c, {}) for c in VALUES if "1" not in c),
    )
    results = results_of(small(VALUES, cases=cases))
    assert pooled_contrast(results, "mse", "a", "b").n == 4


def test_an_untested_contrast_is_never_separable(small):
    lone = pooled_contrast(results_of(small({"row": {"a": [1.0], "b": [9.0]}})), "mse", "a", "b")
    (found,) = corrected_contrasts([lone])
    assert np.isnan(found.p)
    assert not found.separable
