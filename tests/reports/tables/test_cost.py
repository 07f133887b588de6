import pytest

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.tables.cost import cost_table


def results_of(bundle, task=0):
    return task_results(bundle, bundle.layouts[task])


def test_cost_is_the_median_of_seconds_and_the_peak_of_memory(small):
    bundle = small({"row": {"a": [1.0, 1.0, 1.0, float("nan")]}})
    bundle.records["fit_seconds"] = [1.0, 2.0, 9.0, 99.0]
    bundle.records["peak_memory_mb"] = [10.0, 30.0, 20.0, 99.0]
    (cost,) = cost_table(results_of(bundle)).rows
    assert [cell.text for cell in cost[:5]] == ["a", "3", "2", "1", "30"]


def test_what_no_label_has_gets_no_column(small):
    bundle = small({"row": {"a": [1.0], "b": [1.0]}})
    bundle.records[["iterations", "converged", "engine"]] = [[3.0, None, ""], [None, None, ""]]
    table = cost_table(results_of(bundle))
    titles = [column.text for column in table.columns]
    assert titles[-1] == "iterations, median"
    assert [row[-1].text for row in table.rows] == ["3", "–"]


def test_convergence_is_a_share_and_absent_where_it_means_nothing(bundle):
    table = cost_table(results_of(bundle))
    place = [column.text for column in table.columns].index("converged")
    shares = {row[0].text: row[place].text for row in table.rows}
    assert 50 < int(shares["mohgp-3"].rstrip("%")) <= 100
    assert shares["cubic-spline"] == "–"


def test_each_engine_is_named_once(small):
    bundle = small({"row": {"a": [1.0, 1.0, 1.0], "b": [1.0, 1.0, 1.0]}})
    bundle.records["engine"] = ["dense: least work", "split: also", "dense: least work", "", "", ""]
    table = cost_table(results_of(bundle))
    (_, *_, first), (_, *_, second) = table.rows
    assert (first.text, first.note) == ("dense, split", "")
    assert second.text == "–"


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        *((0.0, "< 0.001"), (2.25e-05, "< 0.001"), (0.00123, "0.00123"), (0.5, "0.5")),
        *((12.345, "12.3"), (1234.5, "1230"), (float("nan"), "–")),
    ],
)
def test_seconds_are_never_a_power_of_ten(small, seconds, text):
    bundle = small({"row": {"a": [1.0]}})
    bundle.records["fit_seconds"] = [seconds]
    ((_, _, fit, *_),) = cost_table(results_of(bundle)).rows
    assert fit.text == text


def test_nothing_finished_nothing_costs(small):
    assert cost_table(results_of(small({"row": {"a": [float("nan")]}}))) is None
