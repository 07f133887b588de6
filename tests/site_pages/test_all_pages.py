"""There is a page for each registered name, and it says what is registered."""

import re
from importlib import import_module
from pathlib import Path

import pytest
from catalogue.site import pages

from mocapbench.baselines import Imputer
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS

REGISTRIES = {"tasks": TASKS, "models": MODELS, "metrics": METRICS}
EXAMPLE = Path(__file__).parents[2] / "examples" / "third-party" / "src"


@pytest.mark.slow
@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_name_has_a_page_and_a_place_in_the_index(texts, kind):
    names = REGISTRIES[kind].names()
    assert sorted(texts[kind]) == sorted([*names, "index"])
    linked = re.findall(rf"</generated/{kind}/([\w-]+)>`", texts[kind]["index"])
    assert sorted(linked) == sorted(names)
    assert sorted(re.findall(r"^   ([\w-]+)$", texts[kind]["index"], re.MULTILINE)) == [*names]


def test_every_link_leads_to_a_page(texts):
    for of_kind in texts.values():
        for text in of_kind.values():
            for kind, name in re.findall(r"</generated/(\w+)/([\w-]+)>", text):
                assert name in texts[kind], (kind, name)


@pytest.mark.parametrize("name", [n for n in MODELS.names() if "mocapbench" in str(MODELS.get(n))])
def test_a_model_says_its_formula_and_every_parameter(texts, name):
    text = texts["models"][name]
    assert re.search(r":math:|\.\. math::", text), "no formula"
    described = re.findall(r"^``([\w, ]+)`` : ", text, re.MULTILINE)
    said = {parameter for names in described for parameter in names.split(", ")}
    assert said == set(MODELS.get(name)().get_params())


@pytest.mark.parametrize("name", METRICS.names())
def test_a_metric_says_formula_pitfalls_and_an_example(texts, name):
    text = texts["metrics"][name]
    assert ".. math::" in text
    assert re.search(r"^Pitfalls\n-+\n\n\S", text, re.MULTILINE)
    assert "from mocapbench.metrics import" in text
    assert METRICS.get(name).sentence in text.replace("\\", "")


@pytest.mark.parametrize("name", TASKS.names())
def test_a_task_says_which_recordings_it_takes(texts, tables, name):
    keys = {
        key
        for _, rows in tables(texts["tasks"][name])
        if rows and rows[0][:2] == ["library", "subject"]
        for row in rows[1:]
        for key in row[2].split(", ")
    }
    wanted = {uri for case in TASKS.get(name).cases for uri in case.recordings}
    assert keys == {uri.partition(":")[2] for uri in wanted}


def test_missing_recordings_are_said(texts):
    missing = [name for name in TASKS.names() if "Not on the machine" in texts["tasks"][name]]
    on_people = [
        name
        for name in TASKS.names()
        if any(
            uri.startswith(("cmu:", "lafan1:", "rotations:"))
            for case in TASKS.get(name).cases
            for uri in case.recordings
        )
    ]
    assert missing == on_people


class NoDocstring(Imputer):
    """"""

    def fit(self, recordings):
        """Return the model."""
        return self

    def impute(self, recordings):
        """Return nothing."""
        return []


@pytest.mark.slow
def test_a_third_party_package_gets_pages_too(monkeypatch, goldens, without_recordings):
    monkeypatch.syspath_prepend(str(EXAMPLE))
    model, task, metric = (
        import_module(f"mocapbench_waves.{name}") for name in ("model", "task", "metric")
    )
    monkeypatch.setitem(MODELS._added, "straight-lines", model.StraightLines)
    monkeypatch.setitem(MODELS._added, "undescribed", NoDocstring)
    monkeypatch.setitem(TASKS._added, "waves", task.waves)
    monkeypatch.setitem(METRICS._added, "median_absolute_error", metric.median_absolute_error)
    texts = pages(goldens)
    assert "There are no stored reference values" in texts["models"]["straight-lines"]
    assert "There are no stored reference values" in texts["tasks"]["waves"]
    assert "</generated/tasks/waves>" in texts["metrics"]["median_absolute_error"]
    assert "no docstring" in texts["models"]["undescribed"]
    assert all("waves" in texts["models"][name] for name in ("straight-lines", "undescribed"))
