import pandas as pd
import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.task_page import RowNotes
from mocapbench.reports.page.sections import task_view
from mocapbench.reports.paper.published import published_values
from mocapbench.reports.tables.scores import score_table

NAN = float("nan")


def table_of(bundle, metric, task=0):
    return score_table(task_results(bundle, bundle.layouts[task]), metric)


def cell(table, case, column):
    row = next(row for row in table.rows if row[0].text == case)
    return row[[heading.text for heading in table.columns].index(column)]


def test_every_row_is_as_wide_as_the_heading(bundle):
    for layout in bundle.layouts:
        for table in task_view(task_results(bundle, layout)).tables:
            assert {sum(cell.span for cell in row) for row in table.rows} == {len(table.columns)}


def test_a_cell_is_the_mean_and_half_its_interval(small):
    found = cell(table_of(small({"row": {"a": [1.0, 3.0], "b": [9.0, 9.0]}}), "mse"), "row", "a")
    assert (found.text, found.spread, found.kind) == ("2.00", "12.71", "best")


def test_one_fold_shows_no_spread_and_says_so(small):
    table = table_of(small({"row": {"a": [1.0]}}), "mse")
    assert cell(table, "row", "a").spread == ""
    assert cell(table, "row", "folds").text == "n=1"


def test_one_cell_of_a_row_is_best_and_it_is_the_least_mean(bundle):
    table = score_table(task_results(bundle, bundle.layouts[0]), "mse")
    for case, rows in table.data[table.data["label"] != "oracle"].groupby("case"):
        (best,) = (label for label in rows["label"] if cell(table, case, label).kind == "best")
        assert best == rows.loc[rows["mean"].idxmin(), "label"]
        assert [best] == rows.loc[rows["best"], "label"].to_list()


CLOSE = {"a": [1.0, 1.2, 0.9, 1.0, 1.1], "b": [1.1, 1.1, 1.0, 1.0, 1.1]}


@pytest.mark.parametrize(
    ("n", "independent", "few"), [(5, True, ""), (3, True, "3 folds"), (5, False, "1 case")]
)
def test_a_note_says_where_units_are_too_few_to_test(small, n, independent, few):
    values = {label: folds[:n] for label, folds in CLOSE.items()}
    notes = table_of(small({"row": values}, independent_folds=independent), "mse").notes
    assert notes[0] == "Bold: the best mean of a row."
    assert [note.partition(".")[0] for note in notes[1:]] == (
        [f"Too few to test: rows over {few}"] if few else []
    )


def test_a_failed_cell_leads_to_its_failure(bundle):
    found = cell(table_of(bundle, "mse"), "test 8", "nn")
    assert (found.text, found.kind) == ("failed", "trouble")
    assert found.link.startswith("job-")


def test_a_partly_failed_cell_says_how_many_folds_are_left(small):
    found = cell(
        table_of(small({"row": {"a": [1.0, NAN, 2.0], "b": [5.0] * 3}}), "mse"), "row", "a"
    )
    assert (found.text, found.note, found.link) == ("1.50", "n=2, 1 failed", "job-1")


def test_every_way_of_failing_is_counted(small):
    bundle = small({"row": {"a": [1.0, NAN, NAN, NAN]}})
    bundle.records["status"] = ["ok", "failed", "timeout", "timeout"]
    found = cell(table_of(bundle, "mse"), "row", "a")
    assert found.note == "1 failed, 2 timeout"


def test_a_metric_that_does_not_apply_is_a_dash(bundle):
    assert cell(table_of(bundle, "msll"), "test 1", "cubic-spline").text == "–"


def test_missing_data_takes_the_row(bundle):
    table = table_of(bundle, "rms_per_frame", task=2)
    found = cell(table, "12-02 four-walkers", "cubic-spline")
    assert (found.text, found.span) == ("data missing", len(bundle.layouts[2].labels))


def test_generated_motion_is_labelled(bundle):
    assert "synthetic" in cell(table_of(bundle, "msll", task=1), "generated 20", "case").note


def test_the_papers_other_columns_come_last(bundle):
    table = table_of(bundle, "rms_per_frame", task=2)
    models = ("GPDM-MAP", "B-GPDM", "GPDM-fixed-alpha", "GPDM-two-stage-MAP")
    assert [c.text for c in table.columns[-4:]] == [f"{model} (published)" for model in models]
    printed = published_values("missing-frames")
    for case in bundle.layouts[2].cases[:2]:
        row = next(row for row in table.rows if row[0].text == case.name)
        values = [printed[case.notes.published, "RMS per frame", model].value for model in models]
        assert [float(each.text) for each in row[-4:]] == values


def test_remarks_and_degenerate_outputs_are_footnotes(small):
    bundle = small({"row": {"a": [1.0, 2.0]}}, remarks=("an erratum",))
    bundle.scores["left_out"] = [0, 3]
    notes = table_of(bundle, "mse").notes
    assert notes[0] == "an erratum"
    assert notes[1] == "Left out as degenerate: up to 3 outputs a fold."


def test_what_distinguishes_cases_is_in_columns(small):
    cases = (CaseLayout("row", {"noise": 0.1}), CaseLayout("other", {"outputs": 3}))
    values = {"row": {"a": [1.0]}, "other": {"a": [2.0]}}
    table = table_of(small(values, cases=cases), "mse")
    assert [c.text for c in table.columns] == ["case", "noise", "outputs", "folds", "a"]
    assert cell(table, "other", "noise").text == ""


def test_the_tidy_data_hold_full_precision(bundle):
    data, scores = table_of(bundle, "mse").data, bundle.scores
    expected = (
        scores[(scores["task"] == "toy-interpolation-1") & (scores["metric"] == "mse")]
        .groupby(["case", "label"])["value"]
        .mean()
    )
    found = data[data["n"] > 0].set_index(["case", "label"])["mean"].sort_index()
    pd.testing.assert_series_equal(found, expected, check_names=False, rtol=1e-12)


@pytest.mark.parametrize(
    ("independent", "words"), [(True, "MSE: mean ± half its 95 % interval,"), (False, "MSE: mean,")]
)
def test_the_caption_names_the_spread(small, independent, words):
    bundle = small({"row": {"a": [1.0, 2.0]}}, independent_folds=independent)
    assert words in table_of(bundle, "mse").caption


@pytest.mark.parametrize("metric", ["mse", "coverage_50"])
def test_the_caption_says_which_way_is_better(small, metric):
    words = {"mse": "lower is better", "coverage_50": "closest to 0.5 is better"}
    assert words[metric] in table_of(small({"row": {"a": [1.0]}}, metric=metric), metric).caption


def test_the_spread_over_samples_is_not_the_interval(small):
    bundle = small({"row": {"a": [1.0, 3.0]}})
    bundle.scores["sample_two_sd"] = [0.4, 0.6]
    table = table_of(bundle, "mse")
    assert cell(table, "row", "a").spread == "12.71"
    assert table.data["sample_two_sd"].to_list() == [0.5]


def test_errata_of_columns_that_only_the_paper_has_are_footnotes(small):
    bundle = small(
        {"row": {"a": [8.0]}, "other": {"a": [9.0]}},
        task="toy-synthesis",
        cases=(
            CaseLayout("row", {}, notes=RowNotes(published="test 1")),
            CaseLayout("other", {}, notes=RowNotes(published="test 2")),
        ),
        published_metrics={"mse": "MCC"},
        published_models={"a": "MOHGP"},
    )
    table = table_of(bundle, "mse")
    assert cell(table, "row", "Control (published)").mark == "a"
    assert cell(table, "other", "Control (published)").mark == ""
    assert table.notes[-1].startswith("a: ")
