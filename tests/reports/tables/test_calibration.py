from dataclasses import replace

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.tables.calibration import calibration_table


def results_of(bundle, task=0):
    return task_results(bundle, bundle.layouts[task])


def test_coverage_stands_beside_its_nominal_value(bundle):
    table = calibration_table(results_of(bundle))
    assert [cell.text for cell in table.rows[0]] == ["nominal", "0.50", "0.80", "0.90", "0.95"]
    assert {row[0].text for row in table.rows[1:]} == {
        *("mohgp-3", "moa-3", "lmc-independent", "gp-independent", "trivial", "oracle")
    }


def test_generated_cases_do_not_count_beside_recordings(small):
    cases = (CaseLayout("made", {}, synthetic=True), CaseLayout("real", {}))
    values = {"made": {"a": [0.1], "b": [0.2]}, "real": {"a": [0.9], "b": [0.8]}}
    table = calibration_table(
        results_of(small(values, metric="coverage_95", cases=cases, metrics=("mse",)))
    )
    assert [[cell.text for cell in row] for row in table.rows[1:]] == [["a", "0.90"], ["b", "0.80"]]


def test_a_target_metric_with_its_own_table_is_not_repeated(small):
    bundle = small({"row": {"a": [0.5]}}, metric="coverage_50")
    assert calibration_table(results_of(bundle)) is None


def test_a_ratio_with_a_target_is_no_calibration(small):
    results = results_of(small({"row": {"a": [0.5]}}, metric="variance_ratio"))
    page = replace(results.layout.page, metrics=("mse",))
    elsewhere = replace(results, layout=replace(results.layout, page=page))
    assert calibration_table(elsewhere) is None
