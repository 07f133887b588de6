"""The toy synthesis task, its control, and the check that rests on it."""

from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines.control import Control
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.oracle import Oracle
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.toy_interpolation_1 import toy_interpolation_1
from mocapbench.benchmark.tasks.toy_synthesis import toy_synthesis
from mocapbench.datasets import open_archive
from mocapbench.metrics import mcc, mlc, variance_ratio

SAMPLERS = Path(__file__).parents[1] / "samplers.py"


def posed(case, fold=0, root=0):
    seeds = Seeds(root, toy_synthesis.name, toy_synthesis.version, case.name, fold)
    return toy_synthesis.problem(case, seeds, open_archive(None))


@pytest.mark.parametrize("case", toy_synthesis.cases, ids=lambda case: case.name)
def test_children_references_and_control_are_as_the_table_says(case):
    problem, d = posed(case), case.settings["outputs"]
    assert len(problem.train) == case.settings["children"]
    assert len(problem.references) == problem.n_samples == 25
    assert {r.values.shape for r in problem.train} == {(30, d)}
    assert {reference.shape for reference in problem.references} == {(30, d)}
    for process in (problem.process, problem.control):
        assert (process.n_outputs, process.noise) == (d, case.settings["noise"])
        assert len(process.parent.lengthscales) == len(process.child.lengthscales) == 3


def test_it_takes_over_the_tests_of_the_interpolation():
    for one, other in zip(toy_synthesis.cases, toy_interpolation_1.cases, strict=True):
        assert (one.name, one.settings) == (other.name, other.settings)


def test_no_reference_is_a_training_recording():
    problem = posed(toy_synthesis.cases[0])
    curves = [*problem.references, *(recording.values for recording in problem.train)]
    assert len({curve.tobytes() for curve in curves}) == len(curves)


def test_outputs_are_all_correlated_positively():
    """W from U(0, 1), unlike the interpolation's, has no signs (thesis §5.2.1)."""
    problem = posed(toy_synthesis.cases[0])
    for layer in (problem.process.parent, problem.control.child):
        assert (layer.coregionalisation > 0.0).all()


def test_the_control_is_drawn_apart_from_the_data_and_new_in_every_fold():
    one, again, other = (posed(toy_synthesis.cases[0], fold) for fold in (0, 0, 1))
    scales = [p.control.parent.lengthscales for p in (one, again, other)]
    np.testing.assert_array_equal(scales[0], scales[1])
    assert not np.intersect1d(scales[0], scales[2]).size
    assert not np.intersect1d(scales[0], one.process.parent.lengthscales).size


def test_only_a_task_with_a_control_takes_the_control_model():
    assert toy_synthesis.accepts(MODELS.get("control"))
    assert toy_synthesis.accepts(MODELS.get("oracle"))
    assert not toy_interpolation_1.accepts(MODELS.get("control"))


def test_new_children_resemble_the_references_and_the_control_does_not():
    problems = [posed(case) for case in toy_synthesis.cases[::3]]
    scores = {
        model: [problem.outcome(problem.solve(problem.fit(model()), 1)) for problem in problems]
        for model in (Oracle, Control)
    }
    of_oracle, of_control = ([mlc(each).value for each in scores[m]] for m in (Oracle, Control))
    assert np.min(of_oracle) > 0.3
    assert abs(np.mean(of_control)) < 0.2
    assert np.mean([variance_ratio(each).value for each in scores[Oracle]]) == pytest.approx(
        1.0, abs=0.2
    )


@pytest.mark.slow
def test_the_hierarchy_comes_close_to_the_oracle():
    """Over the nine tests: MLC within .05, MCC within 3 %, and the variance of new children."""
    found = {"mohgp": [], "oracle": []}
    for case in toy_synthesis.cases:
        problem = posed(case)
        models = {"mohgp": MOHGP(n_components=3, kernel="rbf"), "oracle": Oracle()}
        for name, model in models.items():
            outcome = problem.outcome(problem.solve(problem.fit(model), 1))
            found[name].append([metric(outcome).value for metric in (mlc, mcc, variance_ratio)])
    ours, limit = (np.array(scores).T for scores in found.values())
    assert np.mean(ours[0] - limit[0]) == pytest.approx(0.0, abs=0.05)
    assert np.mean(ours[1] / limit[1]) == pytest.approx(1.0, abs=0.03)
    assert np.mean(ours[2]) == pytest.approx(1.0, abs=0.25)


@pytest.fixture
def run(cli, tmp_path):
    """Return a function that runs models, samplers.py among them, and checks two tests."""

    def do(models):
        arguments = ("--tasks", "toy-synthesis", "--cases", "test 1,test 7", "--folds", 3)
        files = ("--model-file", SAMPLERS, "--out", tmp_path / "run")
        assert cli("run", *arguments, "--models", models, *files) == 0
        return cli("check", "--controls", tmp_path / "run")

    return do


@pytest.mark.slow
def test_the_check_tells_a_sampler_from_one_that_has_collapsed(cli, run, records, tmp_path):
    assert run("resampler,collapsed,control") == 1
    scores = {"resampler": [], "collapsed": []}
    for (_, _, label, _), record in records(tmp_path / "run").items():
        scores.get(label, []).append(record["scores"]["mlc"])
    assert np.mean(scores["collapsed"]) > np.mean(scores["resampler"])
    assert "collapsed fails by variance ratio: test 1 fold 0 0.0" in cli.printed
    assert "resampler fails" not in cli.printed
    assert run("resampler,control") == 0
    assert "failed" not in cli.printed


def test_a_run_without_a_control_has_nothing_to_check(cli, tmp_path):
    Store.create(tmp_path).save_plan({"keys": [], "provenance": {}})
    assert cli("check", "--controls", tmp_path) == 4
    assert "nothing to check" in cli.printed


@pytest.fixture
def scored(tmp_path):
    """Return a maker of runs of toy-synthesis from {label: [scores or status per fold]}."""

    def make(entrants):
        store, keys = Store.create(tmp_path), []
        for label, folds in entrants.items():
            for fold, found in enumerate(folds):
                fields = {"status": found, "message": "no luck"}
                if isinstance(found, dict):
                    fields = {"status": Status.OK, "scores": found}
                keys.append(key := f"{label}-{fold}")
                where = ("toy-synthesis", 1, "test 1", fold, 0, label, label, {})
                store.save(Record(key, key, *where, **fields, provenance={}))
        store.save_plan({"keys": keys, "provenance": {}})
        return store.path

    return make


SCORES = {
    "control": [{"mlc": m, "mcc": 7.0 + m, "variance_ratio": 1.0} for m in (0.02, -0.03, 0.01)],
    "replay": [
        {"mlc": 0.8 + m, "mcc": 9.0 + m, "variance_ratio": 1.0} for m in (0.02, -0.03, 0.05)
    ],
}


@pytest.mark.parametrize(
    ("changed", "code"),
    [
        ({}, 0),
        ({"replay": [*SCORES["replay"], Status.FAILED]}, 3),
        ({"control": [Status.FAILED]}, 3),
        ({"replay": [*SCORES["control"], Status.FAILED]}, 1),
    ],
)
def test_a_failed_job_is_never_a_passed_control_check(cli, scored, changed, code):
    assert cli("check", "--controls", scored({**SCORES, **changed})) == code
    assert ("jobs failed and were not checked" in cli.printed) == bool(changed)


def test_the_check_must_be_told_what_to_check(cli, tmp_path):
    assert cli("check", tmp_path) == 2
    assert "choose --baseline or --controls" in cli.printed
    assert cli("check", "--controls", tmp_path) == 2
    assert "is not a mocapbench run" in cli.printed
