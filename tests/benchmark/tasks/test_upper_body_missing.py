"""What is hidden of a walk, what is given, and the paper's simple model on real walks."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import NN, Prediction
from mocapbench.benchmark import METRICS
from mocapbench.benchmark.tasks.hlm_recordings import SYNTHETIC
from mocapbench.benchmark.tasks.upper_body_missing import N_WALKS

NAME = "upper-body-missing"
GOLDENS = Path(__file__).parents[2] / "goldens"


@pytest.fixture(scope="module")
def synthetic(posed):
    return posed(NAME, "synthetic walks", 2)


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
    assert [r.name for r in synthetic.train] == [u for u in SYNTHETIC if u != given.name]
    assert all(recording.visible.all() for recording in synthetic.train)


def test_a_score_is_in_squared_degrees_per_hidden_angle(synthetic):
    (given,), (truth,) = synthetic.given, synthetic.truth
    off = (Prediction(np.where(given.visible, truth, truth + 3.0)),)
    assert METRICS.get("mse")(synthetic.outcome(off)).value == pytest.approx(9.0)


@pytest.mark.slow
@pytest.mark.recordings
@pytest.mark.skipif("MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names nothing")
def test_the_nearest_neighbour_errs_on_eleven_walks_as_it_did(posed, num_regression):
    """The paper prints 23.9 for one walk that it does not name."""
    errors = {}
    for fold in range(N_WALKS):
        problem = posed(NAME, "subject 07 walks", fold)
        outcome = problem.outcome(problem.solve(problem.fit(NN()), 0))
        errors[problem.given[0].name] = METRICS.get("mse")(outcome).value
    assert np.mean(list(errors.values())) == pytest.approx(22.0, abs=0.1)
    golden = GOLDENS / "upper-body-missing-nn.csv"
    num_regression.check(errors, default_tolerance={"rtol": 1e-9, "atol": 0}, fullpath=golden)
