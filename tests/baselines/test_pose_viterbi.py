import pickle
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import recording

from mocapbench.baselines import pose_viterbi
from mocapbench.baselines.common.shortest_path import cheapest_path
from mocapbench.baselines.pose_viterbi import PoseViterbi


def circle(start, n_frames):
    angle = 0.3 * (start + np.arange(n_frames))
    return np.column_stack([np.cos(angle), np.sin(angle)])


def gap(n_frames, first, last):
    hidden = np.zeros((n_frames, 2), dtype=bool)
    hidden[first:last] = True
    return hidden


@given(st.integers(0, 2**32 - 1), st.integers(1, 4), st.integers(1, 4))
def test_no_path_is_cheaper(seed, n_times, n_states):
    rng = np.random.default_rng(seed)
    emission, transition = rng.random((n_times, n_states)), rng.random((n_states, n_states))

    def cost(path):
        steps = sum(transition[a, b] for a, b in pairwise(path))
        return steps + sum(emission[t, s] for t, s in enumerate(path))

    best = min(map(cost, product(range(n_states), repeat=n_times)))
    assert np.isclose(cost(cheapest_path(emission, transition)), best)


@pytest.mark.parametrize(("first", "last"), [(8, 20), (0, 10), (18, 30)])
def test_a_stretch_of_training_is_found_wherever_the_gap_is(first, last):
    model = PoseViterbi(subject_offset=0.0).fit([recording("train", circle(0, 60))])
    truth = recording("new", circle(11, 30))
    (filled,) = model.impute([truth.hide(gap(30, first, last))])
    np.testing.assert_allclose(filled.mean, truth.values, atol=1e-10)


def test_a_constant_offset_of_the_subject_is_found():
    model = PoseViterbi().fit([recording("train", circle(0, 20))])
    truth = recording("new", np.add(circle(2, 16), [0.1, -0.05]))
    (filled,) = model.impute([truth.hide(gap(16, 4, 12))])
    np.testing.assert_allclose(filled.mean, truth.values, atol=1e-10)


def test_a_path_does_not_run_on_past_the_end_of_a_training_stretch():
    model = PoseViterbi().fit([recording("a", [[0.0], [1.0]]), recording("b", [[9.0], [10.0]])])
    assert np.isinf(model.transition_[[1, 3]]).all()
    assert model.transition_[0, 1] == model.transition_[2, 3] == 0.0


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"smoothness": 0.0}, "smoothness to be a finite positive"),
        ({"subject_offset": 2.0}, "from 0 to 1"),
    ],
)
def test_parameters_are_validated(parameters, message):
    with pytest.raises(ValueError, match=message):
        PoseViterbi(**parameters).fit([recording("train", circle(0, 10))])


def test_what_cannot_be_filled_is_refused():
    with pytest.raises(ValueError, match="two consecutive frames"):
        PoseViterbi().fit([recording("train", [[1.0, 2.0]])])
    model = PoseViterbi().fit([recording("train", circle(0, 10))])
    with pytest.raises(ValueError, match="'new': expected a visible frame"):
        model.impute([recording("new", circle(0, 5)).hide(gap(5, 0, 5))])
    with pytest.raises(ValueError, match="expected channels"):
        model.impute([recording("new", [[1.0], [2.0]])])
    partly = circle(0, 5)
    partly[2, 0] = np.nan
    with pytest.raises(ValueError, match="hidden in part"):
        model.impute([recording("new", partly)])


def test_states_between_frames_follow_a_slower_motion():
    """A motion at three quarters of the pace stays near the path with four states a frame."""
    train = recording("train", circle(0, 60))
    angle = 0.225 * np.arange(40)
    truth = np.column_stack([np.cos(angle), np.sin(angle)])
    given = recording("new", truth).hide(gap(40, 10, 25))
    errors = [
        np.abs(PoseViterbi(steps=steps).fit([train]).impute([given])[0].mean - truth).max()
        for steps in (1, 4)
    ]
    assert errors[1] < 0.6 * errors[0]


def test_the_states_of_a_frame_pass_through_it():
    train = recording("train", circle(0, 20))
    one, four = (PoseViterbi(steps=steps).fit([train]) for steps in (1, 4))
    np.testing.assert_allclose(four.frames_[::4], one.frames_, atol=1e-12)
    np.testing.assert_allclose(four.transition_[::4, ::4], one.transition_, atol=1e-9)


def test_what_is_handed_to_other_processes_grows_with_frames_and_not_with_their_pairs():
    sizes = [
        len(pickle.dumps(PoseViterbi().fit([recording("train", circle(0, n_frames))])))
        for n_frames in (400, 800)
    ]
    assert sizes[1] < 2.5 * sizes[0]


def test_a_second_fit_forgets_the_costs_of_the_first():
    other, train = (recording("train", circle(0, n_frames)) for n_frames in (30, 40))
    model = PoseViterbi().fit([other])
    assert model.transition_.shape == (30, 30)
    np.testing.assert_array_equal(
        model.fit([train]).transition_, PoseViterbi().fit([train]).transition_
    )


@pytest.fixture
def match_near(monkeypatch):
    """Return a function that matches as where states are too many to search all."""

    def match_near(train, given_):
        with monkeypatch.context() as few:
            few.setattr(pose_viterbi, "_SEARCHED", 0)
            return PoseViterbi(1.0, steps=4).fit([train]).match(given_)

    return match_near


def draw_walk(seed, n_frames):
    return np.random.default_rng(seed).standard_normal((n_frames, 3)).cumsum(axis=0)


def draw_gap(seed, n_frames):
    """Return a recording whose frames 3 to 5 are hidden."""
    hidden = np.repeat((np.arange(n_frames) // 3 == 1)[:, None], 3, axis=1)
    return recording("new", draw_walk(seed, n_frames)).hide(hidden)


def cost(model, given_, poses):
    """Return what a path costs through states that have these poses."""
    taken = (np.abs(poses[:, None] - model.frames_).sum(axis=2)).argmin(axis=1)
    seen = given_.visible.all(axis=1)
    after = np.minimum(taken + model.steps, model.last_[taken])
    jumps = model.frames_[after[:-1]] - model.frames_[taken[1:]]
    assert (taken[:-1] + model.steps <= model.last_[taken[:-1]]).all()
    return ((given_.values - poses)[seen] ** 2).sum() + model.smoothness * (jumps**2).sum()


@pytest.mark.parametrize("seed", range(8))
def test_a_path_near_that_through_frames_is_no_dearer_and_none_is_cheaper_than_the_best(
    seed, match_near
):
    train, given_ = recording("train", draw_walk(seed, 12)), draw_gap(seed + 99, 9)
    best = PoseViterbi(1.0, steps=4).fit([train])
    through_frames = PoseViterbi(1.0).fit([train]).match(given_)
    matches = best.match(given_), match_near(train, given_), through_frames
    costs = [cost(best, given_, poses) for poses in matches]
    assert costs == sorted(costs)


@pytest.mark.parametrize("seed", range(8))
def test_where_all_states_are_near_frames_first_changes_nothing(seed, match_near):
    train, given_ = recording("train", draw_walk(seed, 2)), draw_gap(seed + 99, 7)
    best = PoseViterbi(1.0, steps=4).fit([train]).match(given_)
    np.testing.assert_allclose(match_near(train, given_), best, atol=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_rough_match_is_that_of_frames_first(seed, match_near):
    train, given_ = recording("train", draw_walk(seed, 12)), draw_gap(seed + 99, 9)
    rough = PoseViterbi(1.0, steps=4).fit([train]).match_roughly(given_)
    np.testing.assert_array_equal(rough, match_near(train, given_))


def test_a_second_fit_forgets_the_rough_costs_of_the_first():
    given_, model = draw_gap(99, 9), PoseViterbi(1.0, steps=4)
    model.fit([recording("other", draw_walk(1, 15))]).match_roughly(given_)
    fresh = PoseViterbi(1.0, steps=4).fit([recording("train", draw_walk(0, 12))])
    rough = model.fit([recording("train", draw_walk(0, 12))]).match_roughly(given_)
    np.testing.assert_array_equal(rough, fresh.match_roughly(given_))
