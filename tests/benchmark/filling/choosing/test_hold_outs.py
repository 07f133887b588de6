from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.choosing.hold_outs import EXCERPT, has_room, make_hold_outs
from mocapbench.benchmark.filling.choosing.kinds import Kind, tell_kinds
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.gaps import Gap, find_gaps, mask_ends, mask_gaps
from mocapbench.datasets import Recording

N_FRAMES = 200
BLOCKS = st.lists(
    st.tuples(st.integers(0, N_FRAMES), st.integers(1, 30), st.integers(0, 2)),
    min_size=1,
    max_size=4,
)


def problem(blocks):
    target = np.zeros((N_FRAMES, 3), dtype=bool)
    for start, length, channel in blocks:
        target[min(start, N_FRAMES - 1) : start + length, channel] = True
    values = np.arange(3.0 * N_FRAMES).reshape(N_FRAMES, 3)
    whole = Recording("r", np.arange(N_FRAMES) / 10, values, ("a", "b", "c"), ("", "", ""))
    return GapProblem(whole.hide(target), target)


@settings(deadline=None)
@given(BLOCKS)
def test_hold_outs_know_the_truth_and_hide_it(blocks):
    asked = problem(blocks)
    for hold_out in make_hold_outs(asked, np.random.default_rng(0)):
        target = hold_out.problem.target
        first = round(hold_out.problem.given.times[0] * 10)
        whole = np.arange(3.0 * N_FRAMES).reshape(N_FRAMES, 3)[first : first + len(target)]
        np.testing.assert_array_equal(hold_out.truth, whole[target])
        assert not hold_out.problem.given.visible[target].any()
        positions = np.sort(np.concatenate([gap.entries for gap in hold_out.gaps]))
        np.testing.assert_array_equal(positions, np.arange(target.sum()))
        seen = hold_out.problem.given.visible
        np.testing.assert_array_equal(hold_out.problem.given.values[seen], whole[seen])


@settings(deadline=None)
@given(BLOCKS)
def test_every_held_out_gap_has_the_shape_of_a_real_one(blocks):
    asked = problem(blocks)
    kinds = tell_kinds(asked)
    for hold_out in make_hold_outs(asked, np.random.default_rng(0)):
        first = round(hold_out.problem.given.times[0] * 10)
        for gap in hold_out.gaps:
            assert kinds[gap.original][gap.kind] == gap.copy.channels == gap.original.channels
            assert len(gap.copy) <= len(gap.original)
        hidden = mask_gaps((gap.copy.move(-first) for gap in hold_out.gaps), asked.target.shape)
        target = hold_out.problem.target
        np.testing.assert_array_equal(hidden[: len(target)], target)
        assert hidden.sum() == target.sum()


@settings(deadline=None)
@given(st.integers(4, 12), st.integers(1, 2), st.integers(0, 100))
def test_no_two_hold_outs_are_alike_however_short_the_recording(n_frames, length, seed):
    values = np.arange(2.0 * n_frames).reshape(n_frames, 2)
    target = np.zeros((n_frames, 2), dtype=bool)
    target[1 : 1 + length, 0] = True
    whole = Recording("r", np.arange(n_frames) / 10, values, ("a", "b"), ("", ""))
    hold_outs = make_hold_outs(GapProblem(whole.hide(target), target), np.random.default_rng(seed))
    hidden = [hold_out.problem.target.tobytes() for hold_out in hold_outs]
    assert len(set(hidden)) == len(hidden)


def test_hold_outs_of_a_long_recording_are_excerpts_that_share_no_frames():
    """So what a model costs in one does not grow with the recording."""
    n_frames = 4 * EXCERPT
    target = np.zeros((n_frames, 3), dtype=bool)
    target[100:150, 0] = target[9000:9100, 1] = True
    whole = Recording(
        "r", np.arange(n_frames) / 10, np.ones((n_frames, 3)), ("a", "b", "c"), ("",) * 3
    )
    hold_outs = make_hold_outs(GapProblem(whole.hide(target), target), np.random.default_rng(0))
    starts = [round(one.problem.given.times[0] * 10) for one in hold_outs]
    assert {*starts} < {0, EXCERPT, 2 * EXCERPT, 3 * EXCERPT}
    assert len({*starts}) == len(starts) > 2
    assert all(len(one.problem.given.times) == EXCERPT for one in hold_outs)
    for start, one in zip(starts, hold_outs, strict=True):
        there = target[start : start + EXCERPT]
        np.testing.assert_array_equal(one.problem.given.visible, ~(there | one.problem.target))


def test_an_excerpt_is_far_longer_than_a_gap():
    n_frames, length = 4 * EXCERPT, 600
    target = np.zeros((n_frames, 2), dtype=bool)
    target[300 : 300 + length, 0] = True
    whole = Recording("r", np.arange(n_frames) / 10, np.ones((n_frames, 2)), ("a", "b"), ("", ""))
    for one in make_hold_outs(GapProblem(whole.hide(target), target), np.random.default_rng(0)):
        assert len(one.problem.given.times) >= 10 * length
        assert {len(gap.copy) for gap in one.gaps} == {length}


def test_gaps_at_the_ends_are_tried_at_the_ends():
    asked = problem([(0, 10, 0), (190, 10, 1)])
    for hold_out in make_hold_outs(asked, np.random.default_rng(0)):
        gaps = find_gaps(hold_out.problem.target)
        assert {(gap.start, gap.channels) for gap in gaps if gap.start == 0} == {(0, (0,))}
        assert {gap.channels for gap in gaps if gap.stop == len(hold_out.problem.target)} == {(1,)}


@pytest.mark.parametrize("end", [(0, 10, 0), (190, 10, 0)])
def test_gaps_at_an_end_are_tried_whether_or_not_another_channel_is_lost(end):
    alone, beside = (
        make_hold_outs(problem(blocks), np.random.default_rng(0))
        for blocks in ([end], [end, (0, N_FRAMES, 1)])
    )
    assert {gap.original.channels for gap in list_gaps(beside)} == {(0,)}
    assert [g.copy for g in list_gaps(beside)] == [g.copy for g in list_gaps(alone)]


def test_gaps_of_a_kind_get_about_equally_many_copies():
    asked = problem([(20, 12, 0), (80, 25, 1), (150, 15, 2)])
    hold_outs = make_hold_outs(asked, np.random.default_rng(0))
    counts = Counter(len(gap.copy) for gap in list_gaps(hold_outs))
    assert {*counts} == {12, 15, 25}
    assert max(counts.values()) - min(counts.values()) <= 2


def test_a_gap_longer_than_any_visible_stretch_is_shortened():
    asked = problem([(60, 110, 0)])
    hold_outs = make_hold_outs(asked, np.random.default_rng(0))
    assert {len(gap.copy) for gap in list_gaps(hold_outs)} == {55}


def test_there_is_no_hold_out_without_room():
    asked = problem([(1, 198, 0)])
    assert make_hold_outs(asked, np.random.default_rng(0)) == []


@pytest.mark.parametrize("seed", [0, 1])
def test_the_same_seed_makes_the_same_hold_outs(seed):
    asked = problem([(20, 5, 0)])
    one, two = (make_hold_outs(asked, np.random.default_rng(seed)) for _ in range(2))
    for first, second in zip(one, two, strict=True):
        np.testing.assert_array_equal(first.problem.target, second.problem.target)


def test_no_gap_is_shortened_that_fits_once_another_hold_out_has_the_room():
    """Beside the copy of a long gap there may be no room for a second, but alone there is."""
    asked = problem([(10, 8, 0), (50, 30, 1), (120, 30, 2)])
    for seed in range(10):
        hold_outs = make_hold_outs(asked, np.random.default_rng(seed))
        assert {len(gap.copy) for gap in list_gaps(hold_outs)} == {8, 30}


def test_a_gap_that_does_not_fit_beside_another_waits_for_the_next_hold_out():
    """Frames 40 to 70 alone are visible, in which a long gap fits if no short one is in between."""
    target = np.zeros((N_FRAMES, 2), dtype=bool)
    target[100:118, 0] = target[150:158, 1] = True
    hidden = target.copy()
    hidden[:40] = hidden[70:] = True
    values = np.arange(2.0 * N_FRAMES).reshape(N_FRAMES, 2)
    whole = Recording("r", np.arange(N_FRAMES) / 10, values, ("a", "b"), ("", ""))
    for seed in range(10):
        asked = GapProblem(whole.hide(hidden), target)
        hold_outs = make_hold_outs(asked, np.random.default_rng(seed))
        assert {len(gap.copy) for gap in list_gaps(hold_outs)} == {8, 18}


@settings(deadline=None)
@given(BLOCKS)
def test_gaps_at_the_ends_are_held_out_only_where_there_are_no_others(blocks):
    asked = problem(blocks)
    at_ends = mask_ends(asked.given.visible)
    inner = {gap for gap in find_gaps(asked.target) if not at_ends[gap.start, gap.channels[0]]}
    for hold_out in make_hold_outs(asked, np.random.default_rng(0)):
        copied = {gap.original for gap in hold_out.gaps}
        assert copied <= inner or not inner


def test_a_repeated_hold_out_is_not_the_end():
    """Little room in two channels makes copies alike, but others are still to be had."""
    target = np.zeros((400, 3), dtype=bool)
    target[100:140, 0] = target[200:230, 2] = target[300:306, 1] = True
    hidden = target.copy()
    hidden[:60, 0] = hidden[160:, 0] = hidden[:60, 1] = hidden[160:, 1] = True
    values = np.arange(1200.0).reshape(400, 3)
    whole = Recording("r", np.arange(400) / 10, values, ("a", "b", "c"), ("", "", ""))
    for seed in range(5):
        hold_outs = make_hold_outs(
            GapProblem(whole.hide(hidden), target), np.random.default_rng(seed)
        )
        assert len(hold_outs) > 5


def test_a_hold_out_that_ends_in_a_gap_may_end_anywhere_in_the_last_third():
    asked = problem([(170, 30, 0)])
    hold_outs = [t for seed in range(5) for t in make_hold_outs(asked, np.random.default_rng(seed))]
    ends = [len(hold_out.problem.target) for hold_out in hold_outs]
    assert {len(gap.copy) for gap in list_gaps(hold_outs)} == {30}
    assert 133 <= min(ends) < 145
    assert 160 < max(ends) < 170


def markers(n_frames, *gaps, rate=100):
    """Return the problem of filling gaps (start, length, markers) of three markers, at 100 Hz."""
    target = np.zeros((n_frames, 9), dtype=bool)
    for start, length, hidden in gaps:
        for marker in hidden:
            target[start : start + length, 3 * marker : 3 * marker + 3] = True
    values = np.arange(9.0 * n_frames).reshape(n_frames, 9)
    names = tuple(f"{marker}.{axis}" for marker in "ABC" for axis in "xyz")
    whole = Recording("r", np.arange(n_frames) / rate, values, names, ("mm",) * 9)
    return GapProblem(whole.hide(target), target)


EVERY_KIND = ((100, 5, [0]), (300, 60, [1]), (500, 20, [0, 1, 2]), (800, 8, [0]), (900, 7, [0]))


def test_all_kinds_of_gaps_get_about_equally_many_copies():
    asked = markers(6000, *EVERY_KIND)
    for seed in range(5):
        hold_outs = make_hold_outs(asked, np.random.default_rng(seed))
        counts = Counter(gap.kind for gap in list_gaps(hold_outs))
        assert {*counts} == {
            Kind("mm", "one marker or joint", "up to 0.25 s"),
            Kind("mm", "one marker or joint", "up to 1 s"),
            Kind("mm", "whole frames", "up to 0.25 s"),
        }
        assert min(counts.values()) >= 24
        assert max(counts.values()) <= 1.1 * min(counts.values())


def test_a_gap_of_ten_seconds_shortens_no_other():
    """It fits nowhere, whatever else is held out beside it or overlaps with it in the file."""
    for beside in ((1600, 20, [2]), (500, 20, [1])):
        asked = markers(1700, (300, 1000, [0]), (100, 20, [1]), (1450, 90, [2]), beside)
        for seed in range(3):
            hold_outs = make_hold_outs(asked, np.random.default_rng(seed))
            shortened = {g.original for g in list_gaps(hold_outs) if len(g.copy) < len(g.original)}
            assert shortened == {Gap(300, 1300, (0, 1, 2))}
            copied = {gap.original.start for gap in list_gaps(hold_outs)}
            assert copied == {300, 100, 1450, beside[0]}


@settings(deadline=None)
@given(BLOCKS)
def test_there_is_room_if_a_hold_out_can_be_made(blocks):
    asked = problem(blocks)
    made = make_hold_outs(asked, np.random.default_rng(0))
    assert has_room(asked, np.random.default_rng(0)) is bool(made)
