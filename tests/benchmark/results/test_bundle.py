from dataclasses import replace

import pytest

from mocapbench.benchmark import METRICS, TASKS, Address, Record, Status, bundle
from mocapbench.benchmark.comparison import compare, run_changes
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.results.shown_metrics import shown_metrics

NAME = "upper-body-missing"
TASK = TASKS.get(NAME)


def _record(label, scores):
    address = Address(NAME, TASK.version, "subject 07 walks", 0, label)
    fields = {"key": label, "fit_key": label, "seed": 0, "model": label, "parameters": {}}
    return Record(**fields, address=address, status=Status.OK, scores=scores)


@pytest.fixture(scope="module")
def made():
    records = [_record("nn", {"mse": 2.0}), _record("knn", {"mse": 1.0, "smse": 0.5})]
    return bundle(records, {"profile": "smoke"})


def test_a_layout_has_the_page_of_its_task_and_a_row_per_case(made):
    (layout,) = made.layouts
    assert (layout.name, layout.page) == (NAME, TASK.page)
    assert [(c.name, c.columns, c.synthetic) for c in layout.cases] == [
        (case.name, case.columns, case.synthetic) for case in TASK.cases
    ]
    assert [case.subjects for case in layout.cases] == [("07",), ()]
    assert layout.page.published_rows == {layout.cases[0].name: "subject 07 walk"}


def test_metrics_of_others_follow_those_of_the_page_where_they_were_scored(monkeypatch):
    theirs = replace(METRICS.get("mse"), name="theirs", title="Theirs")
    monkeypatch.setitem(METRICS._added, "theirs", theirs)
    scored = [_record("nn", {"mse": 2.0, "theirs": 3.0, "pit": 0.1}), _record("knn", {"mse": 1.0})]
    (layout,) = bundle(scored, {"profile": "smoke"}).layouts
    assert layout.page.metrics == (*TASK.page.metrics, "theirs")
    assert shown_metrics(TASK, scored[1:]) == TASK.page.metrics
    assert "theirs" in METRICS.names_of_others()
    assert "mse" not in METRICS.names_of_others()
    (compared,) = run_changes(scored, scored, ("a", "b")).metrics.values()
    assert list(compared) == [*TASK.page.metrics, "theirs"]
    rows = compare(scored[:1], [_record("nn", {"theirs": 4.0})], rope=0.0)
    assert {row.metric for row in rows if row.contrast.n} == {"theirs"}


def test_entrants_are_in_the_order_of_the_records(made):
    assert made.layouts[0].labels == ("nn", "knn")


def test_interpolations_are_known_by_the_nature_of_their_model():
    records = [
        _record("nn", {}),
        _record("hold", {}),
        replace(_record("my-spline", {}), model="cubic-spline"),
        replace(_record("linear", {}), model="no longer registered"),
    ]
    (layout,) = bundle(records, {"profile": "smoke"}).layouts
    assert layout.interpolations == ("hold", "my-spline")


def test_each_label_has_the_facts_of_its_model():
    records = [
        replace(_record("nn", {}), model="nn"),
        replace(_record("old", {}), model="no longer registered"),
    ]
    (layout,) = bundle(records, {"profile": "smoke"}).layouts
    nearest, old = (layout.model(label) for label in layout.labels)
    assert (nearest.name, nearest.family, nearest.parameters) == ("nn", "Neighbours", "")
    assert nearest.sentence.startswith("Copy hidden entries")
    assert nearest.source == "Pan and Torresani 2009; Taylor et al. 2007"
    assert (old.name, old.sentence, old.source, old.family) == (
        *("no longer registered", "", "", "Your models"),
    )
    assert layout.model("nobody").name == "nobody"


def test_a_label_has_the_parameters_that_its_entrant_sets():
    task = TASKS.get("missing-frames")
    address = Address(task.name, task.version, task.cases[0].name, 0, "gpdm-map-linear")
    record = replace(_record("gpdm-map-linear", {}), address=address, model="gpdm")
    (layout,) = bundle([record], {}).layouts
    assert layout.model("gpdm-map-linear").parameters == "learning=map, start=linear"


def test_the_budget_of_the_profile_is_written_out(made):
    assert made.layouts[0].budget == "max_iter=3, n_restarts=1, n_styles=2"
    assert bundle([_record("nn", {})], {"profile": "paper"}).layouts[0].budget == ""


def test_metrics_are_those_that_the_page_shows_and_those_that_were_scored(made):
    assert list(made.metrics) == ["mpjpe", "mse", "msll", "smse"]
    assert made.metrics["mse"].title == "Mean squared error (MSE)"
    assert made.metrics["mse"].unit == "that of the data, squared"
    assert made.metrics["mse"].sentence


def test_a_case_that_the_task_does_not_have_is_refused_by_name():
    record = _record("nn", {"mse": 1.0})
    other = replace(record, address=record.address._replace(case="subject 99 walks"))
    with pytest.raises(UnknownNameError, match="subject 99 walks"):
        bundle([other], {})
