"""The toy synthesis task, its control, and the check that rests on it."""

from pathlib import Path

import numpy as np
import pytest
from plans import plan_of

from mocapbench.baselines import MOHGP, Control, Oracle
from mocapbench.benchmark import MODELS, TASKS, Address, Record, RunDirectory, Status
from mocapbench.metrics import mcc, mlc, variance_ratio

DRAWS = range(1, 7)
TASK, INTERPOLATION = TASKS.get("toy-synthesis"), TASKS.get("toy-interpolation-1")
FIRST, *_ = NAMES = [case.name for case in TASK.cases]
SAMPLERS = Path(__file__).parents[1] / "samplers.py"


@pytest.mark.parametrize("case", TASK.cases, ids=lambda case: case.name)
def test_children_references_and_control_are_as_the_table_says(posed, case):
    problem, d = posed(TASK.name, case.name), case.columns["outputs"]
    assert len(problem.train) == case.columns["children"]
    assert len(problem.references) == problem.n_samples == 25
    assert {r.values.shape for r in problem.train} == {(30, d)}
    assert {reference.shape for reference in problem.references} == {(30, d)}
    for process in (problem.process, problem.control):
        assert (process.n_outputs, process.noise) == (d, case.columns["noise"])
        assert len(process.parent.lengthscales) == len(process.child.lengthscales) == 3


def test_it_takes_over_the_tests_of_the_interpolation():
    for one, other in zip(TASK.cases, INTERPOLATION.cases, strict=True):
        assert (one.name, one.columns) == (other.name, other.columns)


def test_no_reference_is_a_training_recording(posed):
    problem = posed(TASK.name, FIRST)
    curves = [*problem.references, *(recording.values for recording in problem.train)]
    assert len({curve.tobytes() for curve in curves}) == len(curves)


def test_outputs_are_all_correlated_positively(posed):
    """W from U(0, 1), unlike the interpolation's, has no signs (thesis §5.2.1)."""
    problem = posed(TASK.name, FIRST)
    for layer in (problem.process.parent, problem.control.child):
        assert (layer.coregionalisation > 0.0).all()


def test_the_control_is_drawn_apart_from_the_data_and_new_in_every_fold(posed):
    one, again, other = (posed(TASK.name, FIRST, fold) for fold in (0, 0, 1))
    scales = [p.control.parent.lengthscales for p in (one, again, other)]
    np.testing.assert_array_equal(scales[0], scales[1])
    assert not np.intersect1d(scales[0], scales[2]).size
    assert not np.intersect1d(scales[0], one.process.parent.lengthscales).size


def test_only_a_task_with_a_control_takes_the_control_model():
    assert TASK.accepts(MODELS.get("control"))
    assert TASK.accepts(MODELS.get("oracle"))
    assert not INTERPOLATION.accepts(MODELS.get("control"))


def test_new_children_resemble_the_references_and_the_control_does_not(posed):
    problems = [posed(TASK.name, name) for name in NAMES[::3]]
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
def test_the_hierarchy_comes_close_to_the_oracle(posed):
    """Over the nine tests: MLC within .05, MCC within 3 %, and the variance of new children.

    Each score is the mean over six draws of samples: the variance ratio of one draw scatters.
    """
    models = (MOHGP(n_components=3, kernel="rbf"), Oracle())
    scores = []
    for problem in (posed(TASK.name, name) for name in NAMES):
        fitted = [problem.fit(model) for model in models]
        outcomes = [[problem.outcome(problem.solve(m, seed)) for seed in DRAWS] for m in fitted]
        scores.append(
            [
                [np.mean([metric(o).value for o in drawn]) for metric in (mlc, mcc, variance_ratio)]
                for drawn in outcomes
            ]
        )
    ours, limit = np.array(scores).transpose(1, 2, 0)
    assert np.mean(ours[0] - limit[0]) == pytest.approx(0.0, abs=0.05)
    assert np.mean(ours[1] / limit[1]) == pytest.approx(1.0, abs=0.03)
    assert np.mean(ours[2]) == pytest.approx(1.0, abs=0.25)


@pytest.fixture
def run(cli, tmp_path):
    """Return a function that runs models, samplers.py among them, and checks two tests."""

    def do(models):
        arguments = ("--tasks", "toy-synthesis", "--cases", "test 1,test 7", "--folds", 3)
        files = ("--plugin", SAMPLERS, "--out", tmp_path / "run")
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
    RunDirectory.create(tmp_path).save_plan(plan_of([]))
    assert cli("check", "--controls", tmp_path) == 4
    assert "nothing to check" in cli.printed


@pytest.fixture
def scored(tmp_path):
    """Return a maker of runs of toy-synthesis from {label: [scores or status per fold]}."""

    def make(entrants):
        store = RunDirectory.create(tmp_path)
        for label, folds in entrants.items():
            for fold, ended in enumerate(folds):
                fields = {"status": ended, "message": "no luck"}
                if isinstance(ended, dict):
                    fields = {"status": Status.OK, "scores": ended}
                key = f"{label}-{fold}"
                address = Address(TASK.name, TASK.version, "test 1", fold, label)
                store.save(Record(key, key, address, 0, label, {}, **fields))
        store.save_plan(plan_of(store.records()))
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
        ({"replay": [*SCORES["replay"], Status.FAILED, Status.FAILED]}, 3),
        ({"control": [Status.FAILED]}, 3),
        ({"replay": [*SCORES["control"], Status.FAILED]}, 1),
    ],
)
def test_a_failed_job_is_never_a_passed_control_check(cli, scored, changed, code):
    assert cli("check", "--controls", scored({**SCORES, **changed})) == code
    assert cli.printed.count("failed, and nothing without a score was checked") == bool(changed)


def test_of_the_exempt_it_is_said_why_and_of_no_other(cli, scored):
    """Who would have to pass, and does, needs no excuse."""
    (exempt, reason), *_ = TASK.page.exempt.items()
    assert cli("check", "--controls", scored({**SCORES, exempt: SCORES["control"]})) == 0
    assert f"{exempt} need not pass: it {reason}" in cli.printed
    assert cli.printed.count("need not pass:") == 1


def _resembling(*advantages):
    """Return scores that are above those of the control by so much, fold by fold."""
    return [
        {name: value + (0 if name == "variance_ratio" else more) for name, value in fold.items()}
        for fold, more in zip(SCORES["control"], advantages, strict=False)
    ]


@pytest.mark.parametrize(
    ("changed", "code"),
    [
        ({"replay": _resembling(0.8, 0.1, 0.2)}, 5),
        ({"replay": _resembling(0.8)}, 5),
        ({name: folds[:1] for name, folds in SCORES.items()}, 5),
        ({"replay": [*_resembling(0.8), Status.FAILED]}, 3),
        ({"replay": _resembling(0.8), "worse": _resembling(-0.8, -0.7, -0.9)}, 1),
    ],
)
def test_too_few_folds_are_undecided_and_not_failed(cli, scored, changed, code):
    run = scored({**SCORES, **changed})
    assert cli("check", "--controls", run) == code
    assert "replay is undecided by MLC and MCC: too few to tell" in cli.printed
    assert "replay fails" not in cli.printed


def test_every_row_of_the_table_fills_every_column_and_ends_with_a_verdict(cli, scored):
    """The control has one number where entrants have three."""
    cli("check", "--controls", scored({**SCORES, "worse": _resembling(-0.8, -0.7, -0.9)}))
    body = cli.printed.partition("┩")[2].partition("└")[0]
    rows = [[cell.strip() for cell in row.strip(" │").split("│")] for row in body.split("│ │")]
    assert [row[0] for row in rows] == ["replay", "worse", "control"]
    assert [row[-1] for row in rows] == ["passed", "failed", "passed"]
    assert {len(row) for row in rows} == {cli.printed.count("╇") + 1}


def test_the_check_needs_something_to_check_against(cli, tmp_path):
    assert cli("check", tmp_path) == 2
    assert "choose --reference or --controls" in cli.printed
    assert cli("check", "--controls", tmp_path) == 2
    assert "is not a mocapbench run" in cli.printed
