from collections import Counter
from importlib.resources import files

import pytest

from mocapbench.reports.paper.published import every_value, parse_published, published_values

HEADER = "source,task,case,settings,metric,model,value,two_sd\n"
ROW = "t1,task,row,,MSE,MOHGP,0.5,0.1\n"


@pytest.fixture(scope="module")
def shipped():
    return parse_published((files("mocapbench.reports.paper") / "published.csv").read_text("utf-8"))


def test_every_number_has_one_address(shipped):
    counts = Counter((v.source, v.case, v.metric, v.model) for v in shipped)
    assert set(counts.values()) == {1}
    assert len(shipped) == 1495


def test_within_a_task_the_papers_names_are_enough(shipped):
    for task in {value.task for value in shipped}:
        assert len(published_values(task)) == sum(value.task == task for value in shipped)


def test_every_row_of_the_tasks_has_a_place_in_their_layouts(bundle):
    averages = {"AVG."}
    for layout in bundle.layouts:
        cases = {*layout.page.published_rows.values()} | averages
        metrics = set(layout.page.published_metrics.values())
        models = {model for _, _, model in published_values(layout.name)}
        assert set(layout.page.published_models.values()) <= models
        for case, metric, _ in published_values(layout.name):
            assert case in cases
            assert metric in metrics


def test_values_of_the_papers():
    assert (
        published_values("missing-frames")["35-03", "RMS per frame", "cubic-spline"].value == 62.98
    )
    row = published_values("toy-interpolation-1")["test 1", "MSE", "MOHGP"]
    assert (row.value, row.two_sd, row.source) == (0.097, 0.077, "thesis-table-01")


def test_an_empty_spread_is_none():
    (value,) = parse_published(HEADER + "t1,task,row,,MSE,MOHGP,0.5,\n")
    assert value.two_sd is None


def test_an_unknown_task_has_no_published_values():
    assert published_values("no such task") == {}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b\n1,2\n", "expected the columns"),
        (HEADER + ROW + ROW, "occurs twice"),
        (HEADER + ROW.replace("0.5", "half"), "line 2.*'half'"),
        (HEADER + ROW.replace("0.1", "±"), "line 2.*'±'"),
    ],
)
def test_a_malformed_table_is_refused(text, message):
    with pytest.raises(ValueError, match=message):
        parse_published(text)


def test_a_column_that_repeats_another_tables_gets_no_verdict():
    repeated, moa = (
        [v for v in every_value() if (v.source, v.metric, v.model) == ("thesis-table-16", "MLC", m)]
        for m in ("MOHGP", "MOA")
    )
    assert sum(v.value for v in repeated) / 5 == pytest.approx(0.209)
    assert all(v.erratum and v.not_comparable for v in repeated)
    assert not any(v.erratum or v.not_comparable for v in moa)
