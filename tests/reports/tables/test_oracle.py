from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.tables.oracle import oracle_table


def results_of(bundle, task=0):
    return task_results(bundle, bundle.layouts[task])


def texts(table):
    return [[cell.text for cell in row] for row in table.rows]


def test_the_ratio_is_the_mean_over_cases_of_ratios_of_fold_means(small):
    values = {
        "one": {"a": [2.0, 4.0], "oracle": [1.0, 1.0]},
        "two": {"a": [1.0, 1.0], "oracle": [2.0, 2.0]},
    }
    table = oracle_table(results_of(small(values, metric="smse_pooled")))
    assert texts(table) == [["a", "1.75×", "2"]]


def test_a_case_that_only_one_has_does_not_count(small):
    values = {
        "one": {"a": [3.0], "oracle": [1.0]},
        "two": {"a": [float("nan")], "oracle": [2.0]},
    }
    table = oracle_table(results_of(small(values, metric="smse_pooled")))
    assert texts(table) == [["a", "3.00×", "1"]]


def test_the_least_ratio_comes_first(bundle):
    ratios = [float(ratio.rstrip("×")) for _, ratio, _ in texts(oracle_table(results_of(bundle)))]
    assert ratios == sorted(ratios)


def test_no_oracle_no_ratio(bundle):
    assert oracle_table(results_of(bundle, task=1)) is None
