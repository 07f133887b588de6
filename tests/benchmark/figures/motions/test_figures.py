"""The players of filled and of invented motion, from solved problems on generated gait."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.benchmark import (
    Solved,
    draw_filled_motion,
    draw_sampled_motion,
)
from mocapbench.benchmark import archive_at as archive
from mocapbench.benchmark.figures.motions.scaled_values import scaled_angles


def filled(problem, offsets):
    """Return solutions that are off by a constant each, also where entries are visible."""
    truth = problem.truth[0]
    return {label: (Prediction(truth + off),) for label, off in offsets.items()}


@pytest.fixture
def gap(posed):
    problem = posed("missing-frames", "synthetic 1")
    solutions = filled(problem, {"right": 0.0, "wrong": 5.0})
    return Solved("missing-frames", problem, solutions, ranking=("right", "wrong"), metric="RMS")


def test_a_filled_gap_is_beside_the_truth(gap):
    (picture,) = draw_filled_motion(gap)
    right, wrong = picture.motions["right"], picture.motions["wrong"]
    assert list(picture.motions) == ["right", "wrong"]
    assert picture.hidden.sum() == 31
    assert picture.interval == pytest.approx(1 / 30)
    np.testing.assert_allclose(right, picture.truths["truth"], atol=1e-9)
    error = np.linalg.norm(wrong - picture.truths["truth"], axis=-1).mean(axis=1)
    assert (error[picture.hidden] > 1.0).all()
    np.testing.assert_allclose(error[: np.argmax(picture.hidden)], 0.0, atol=1e-9)


def test_the_ground_is_below_the_lowest_foot(gap):
    (picture,) = draw_filled_motion(gap)
    assert picture.truths["truth"][..., 1].min() == pytest.approx(0.0)


def test_there_is_no_player_without_a_body_or_without_a_truth(gap):
    bodiless = replace(gap, problem=replace(gap.problem, body=None))
    unknown = gap.problem.truth[0].copy()
    unknown[3:5, 3] = np.nan
    unsure = replace(gap, problem=replace(gap.problem, truth=(unknown,)))
    assert draw_filled_motion(bodiless) == draw_filled_motion(unsure) == ()


def test_a_single_frame_without_a_truth_is_drawn_halfway(gap):
    halfway, unknown = (gap.problem.truth[0].copy() for _ in range(2))
    halfway[3], unknown[3, 3] = (halfway[2] + halfway[4]) / 2, np.nan
    drawn = [
        draw_filled_motion(replace(gap, problem=replace(gap.problem, truth=(truth,))))[0]
        for truth in (halfway, unknown)
    ]
    np.testing.assert_array_equal(drawn[0].truths["truth"], drawn[1].truths["truth"])


def test_scaled_values_are_placed_on_the_spot(posed):
    problem = posed("subject-35-missing", "synthetic right leg")
    solutions = filled(problem, {"right": 0.0, "wrong": 0.5})
    solved = Solved("subject-35-missing", problem, solutions, archive=archive())
    (picture,) = draw_filled_motion(solved, find_body=scaled_angles)
    truth = picture.truths["truth"]
    heights = truth[..., 1].max(axis=1) - truth[..., 1].min(axis=1)
    assert (heights > 120.0).all()  # upright
    np.testing.assert_allclose(truth[:, 0, [0, 2]], 0.0, atol=1e-9)
    leg = [picture.joints.index(name) for name in ("rfemur", "rtibia", "rfoot", "rtoes")]
    moved = np.abs(picture.motions["wrong"] - truth).max(axis=(0, 2)) > 1.0
    assert {*np.flatnonzero(moved)} == {*leg}
    assert draw_filled_motion(replace(solved, archive=None), find_body=scaled_angles) == ()


def test_a_sample_is_beside_the_reference_that_it_is_nearest_to(posed):
    problem = posed("walking-synthesis", "synthetic")
    solutions = {
        f"like-{k + 1}": np.stack([reference, problem.references[0]])
        for k, reference in enumerate(problem.references)
    }
    (picture,) = draw_sampled_motion(Solved("walking-synthesis", problem, solutions))
    assert [picture.truth_of(label) for label in picture.motions] == [
        f"reference {k + 1}" for k in range(len(problem.references))
    ]
    for label, made in picture.motions.items():
        np.testing.assert_allclose(made, picture.truths[picture.truth_of(label)], atol=1e-9)
    assert not picture.hidden.any()
    bodiless = Solved("walking-synthesis", replace(problem, body=None), solutions)
    assert draw_sampled_motion(bodiless) == ()


def test_a_long_recording_is_cut_before_it_is_placed(gap):
    n = 30 * 60
    problem = gap.problem
    whole = np.arange(n) % len(problem.truth[0])
    times = np.arange(n) / 30
    truth = problem.truth[0][whole]
    recording = replace(problem.given[0], times=times, values=truth)
    hidden = np.zeros(truth.shape, dtype=bool)
    hidden[900:930] = True
    asked = []

    class Counting:
        skeleton = problem.body.skeleton

        def positions(self, recording):
            asked.append(len(recording.times))
            return problem.body.positions(recording)

    longer = replace(problem, given=(recording.hide(hidden),), truth=(truth,), body=Counting())
    solved = replace(gap, problem=longer, solutions=filled(longer, {"right": 0.0}))
    (picture,) = draw_filled_motion(solved)
    assert asked == [2 * 300]  # ten seconds of the truth and of one entrant
    assert "10.0 s at 30 Hz, of 60.0 s" in picture.caption
    assert (picture.hidden.sum(), len(picture.hidden)) == (30, 300)
