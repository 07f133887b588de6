"""HLM's tasks: what is hidden, what is given, and the paper's simple model on real walks."""

import os
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.solve import build_model
from mocapbench.benchmark.tasks.hlm_recordings import CMU, SYNTHETIC
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.upper_body_missing import N_WALKS
from mocapbench.datasets import open_archive

UPPER_BODY, STYLES = TASKS.get("upper-body-missing"), TASKS.get("style-clustering")
GOLDENS = Path(__file__).parents[2] / "goldens"


def _problem(task, case, fold=0):
    seeds = Seeds(0, task.name, task.version, case, fold)
    return task.problem(task.case(case), seeds, open_archive())


@pytest.fixture(scope="module")
def synthetic():
    return _problem(UPPER_BODY, "synthetic walks", 2)


def test_the_recordings_are_the_papers_39_in_four_styles():
    subjects = Counter(uri.partition(":")[2][:2] for uri in CMU.sources)
    assert subjects == {"07": 11, "08": 11, "09": 9, "35": 8}
    assert Counter(CMU.styles.values()) == {"walk": 24, "slow walk": 3, "stride": 3, "run": 9}
    assert {CMU.styles[uri] for uri in CMU.of_subject("cmu:09")} == {"run"}


def test_the_generated_recordings_are_of_the_same_styles():
    assert set(SYNTHETIC.styles.values()) == set(CMU.styles.values())
    held_out = SYNTHETIC.of_subject("gait:01")
    assert len(held_out) == len(CMU.of_subject("cmu:07")) == N_WALKS
    assert {SYNTHETIC.styles[uri] for uri in held_out} == {"walk", "slow walk"}


def test_48_joint_angles_are_hidden_in_the_second_half(synthetic):
    (given,) = synthetic.given
    hidden, half = ~given.visible, len(given.times) // 2
    assert not hidden[:half].any()
    assert (hidden[half:] == hidden[half]).all()
    seen = {name for name, lost in zip(given.channels, hidden[half], strict=True) if not lost}
    assert hidden[half].sum() == 48
    assert {name.partition(".")[0] for name in seen} == {
        *("root", "ltibia", "rtibia", "lfoot", "rfoot", "ltoes", "rtoes")
    }
    units = dict(zip(given.channels, given.units, strict=True))
    assert {units[name] for name in set(given.channels) - seen} == {"deg"}


def test_the_walk_is_held_out(synthetic):
    (given,) = synthetic.given
    assert given.name == "gait:01_03"
    assert [r.name for r in synthetic.train] == [u for u in SYNTHETIC.sources if u != given.name]
    assert all(recording.visible.all() for recording in synthetic.train)


def test_a_score_is_in_squared_degrees_per_hidden_angle(synthetic):
    (given,), (truth,) = synthetic.given, synthetic.truth
    off = {"mean-0": np.where(given.visible, truth, truth + 3.0)}
    assert METRICS.get("mse")(synthetic.outcome(off)).value == pytest.approx(9.0)


def test_recordings_are_clustered_without_their_styles():
    problem = _problem(STYLES, "synthetic C = 3")
    assert [recording.name for recording in problem.train] == list(SYNTHETIC.sources)
    outcome = problem.outcome({"labels": np.zeros(len(problem.train), dtype=int)})
    assert METRICS.get("purity")(outcome).value == pytest.approx(12 / 21)


@pytest.mark.parametrize("case", STYLES.cases, ids=lambda case: case.name)
def test_a_case_asks_for_as_many_clusters_as_it_says(case):
    assert case.parameters == {"n_styles": case.settings["styles"]}


@pytest.mark.slow
@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names nothing")
def test_the_nearest_neighbour_errs_on_eleven_walks_as_it_did(num_regression):
    """The paper prints 23.9 for one walk that it does not name."""
    errors = {}
    for fold in range(N_WALKS):
        problem = _problem(UPPER_BODY, "subject 07 walks", fold)
        model = problem.fit(build_model("nn", {}, 0))
        outcome = problem.outcome(problem.solve(model, 0))
        errors[problem.given[0].name] = METRICS.get("mse")(outcome).value
    assert np.mean(list(errors.values())) == pytest.approx(22.0, abs=0.1)
    golden = GOLDENS / "upper-body-missing-nn.csv"
    num_regression.check(errors, default_tolerance={"rtol": 1e-9, "atol": 0}, fullpath=golden)
