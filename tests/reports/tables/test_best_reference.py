import numpy as np
import pandas as pd
import pytest

from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.tables.best_reference import best_reference_table

INFOS = {
    name: MetricInfo(name, name.upper(), Direction.HIGHER)
    for name in ("mcc", "mcc_best", "mlc", "mlc_best")
}
VALUES = {"a": {"mcc": 21.0, "mcc_best": 25.0}, "b": {"mcc": 22.0, "mcc_best": 24.0}}


@pytest.fixture
def results(small):
    """Return results of two entrants, over several references in one case and one in the other."""
    plain = small({"several": {"a": [1.0], "b": [1.0]}, "one": {"a": [1.0], "b": [1.0]}})
    frames = [
        plain.scores.assign(
            metric=metric,
            sample_two_sd=0.5,
            value=[
                np.nan if row.case == "one" and metric == "mcc_best" else VALUES[row.label][metric]
                for row in plain.scores.itertuples()
            ],
        )
        for metric in ("mcc", "mcc_best")
    ]
    (layout,) = plain.layouts
    metrics = {**plain.metrics, **INFOS}
    bundle = Bundle(pd.concat(frames), plain.records, (layout,), metrics, {})
    return task_results(bundle, layout)


def test_the_best_match_stands_beside_the_mean(results):
    table = best_reference_table(results)
    assert [cell.text for cell in table.columns] == ["case", "entrant", "MCC", "MCC_BEST"]
    rows = [[cell.text for cell in row] for row in table.rows]
    assert rows == [["several", "a", "21.00", "25.00"], ["several", "b", "22.00", "24.00"]]
    assert [[cell.kind for cell in row[2:]] for row in table.rows] == [["", "best"], ["best", ""]]
    assert {cell.spread for row in table.rows for cell in row[2:]} == {"0.50"}


def test_no_choice_of_references_no_table(small):
    bundle = small({"row": {"a": [1.0]}})
    assert best_reference_table(task_results(bundle, bundle.layouts[0])) is None
