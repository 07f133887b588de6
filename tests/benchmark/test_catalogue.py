"""What is registered, as plain values."""

import json

import pytest

from mocapbench.baselines import ABILITIES, Imputer
from mocapbench.baselines.declarations.abilities import DEPENDENCES
from mocapbench.benchmark.catalogue.entries import (
    entrant_entry,
    library_entry,
    model_entry,
    task_entry,
)
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES, MODELS, TASKS
from mocapbench.datasets import CMULibrary


@pytest.mark.parametrize("name", MODELS.names())
def test_a_model_says_what_it_is_in_one_line_without_markup(name):
    summary = model_entry(name)["summary"]
    assert summary.endswith(".")
    assert not set("`:\\\n") & set(summary)


def test_markup_and_leading_line_breaks_are_left_out():
    class Mine(Imputer):
        """
        Fill as :class:`~sklearn.X` does with ``n`` neighbours.

        More.
        """

        def fit(self, recordings):
            return self

        def impute(self, recordings):
            return []

    MODELS.add("mine", Mine)
    assert model_entry("mine")["summary"] == "Fill as ~sklearn.X does with n neighbours."
    Mine.__doc__ = None
    assert model_entry("mine")["summary"] == ""


def test_an_ability_that_follows_from_another_is_not_named():
    expected = ["fills any gaps", "new recordings too", "fills alike in any unit"]
    assert model_entry("knn")["abilities"] == expected
    assert "fills any gaps" not in model_entry("cubic-spline")["abilities"]
    assert "fills gaps of whole frames" in model_entry("pose-viterbi")["abilities"]


def test_what_fills_depend_on_is_named():
    assert model_entry("pose-kriging")["depends on"] == []
    assert model_entry("ridge-forecast")["depends on"] == ["the unit"]
    facing = "where markers stand and face"
    assert model_entry("gpdm")["depends on"] == [*DEPENDENCES.values()]
    assert model_entry("lds")["depends on"][:2] == ["where joint angles face", facing]
    assert model_entry("rigid-body")["depends on"] == ["the frame rate"]
    assert model_entry("k-means")["depends on"] == []


@pytest.mark.parametrize("name", TASKS.names())
def test_a_task_is_all_that_json_can_hold(name):
    entry = task_entry(name)
    assert json.loads(json.dumps(entry)) == entry
    for profile in entry["profiles"].values():
        assert set(profile["cases"]) <= set(entry["cases"])
    assert entry["entrants"]
    assert {*entry["requires"]} == {ABILITIES[ability] for ability in TASKS.get(name).requires}


def test_a_library_says_which_files_it_reads():
    assert library_entry("cmu")["layout"] == list(CMULibrary.layout)
    assert all(library_entry(name)["summary"] for name in LIBRARIES.names())


@pytest.mark.parametrize(("label", "model"), [("mohgp-3", "mohgp"), ("hgp", "hgp")])
def test_a_label_is_a_model_with_the_parameters_that_each_task_sets(label, model):
    entry = entrant_entry(label)
    assert entry["name"] == label
    assert entry.get("model", label) == model
    assert entry["parameters"] == model_entry(model)["parameters"]
    for name, parameters in entry["set by tasks"].items():
        entrants = {each.label: each for each in TASKS.get(name).entrants}
        for parameter, value in entrants[label].parameters.items():
            assert f"{parameter}={value!r}" in parameters
    assert "kernel='rbf'" in entry["set by tasks"]["toy-interpolation-1"]


def test_a_label_that_is_not_known_is_told_the_nearest():
    with pytest.raises(UsageError, match="unknown model 'mohgp-33': did you mean mohgp-3"):
        entrant_entry("mohgp-33")
