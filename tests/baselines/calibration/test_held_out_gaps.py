from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.calibration.held_out_gaps import (
    N_SETS,
    copies,
    copies_or_islands,
    halve_gaps,
    hold_out_gaps,
    long_copies,
    remoteness,
)
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import Recording


def recording(hidden):
    values = np.where(hidden, np.nan, 1.0)
    channels = tuple(f"c{d}" for d in range(hidden.shape[1]))
    return Recording("r", np.arange(len(hidden)) / 30, values, channels, ("",) * len(channels))


def with_gaps(seed, n_frames=60):
    """Return a recording with up to two gaps of random channels."""
    rng = np.random.default_rng(seed)
    hidden = np.zeros((n_frames, 4), dtype=bool)
    for _ in range(rng.integers(0, 3)):
        first, length = rng.integers(0, n_frames - 25), rng.integers(1, 25)
        hidden[first : first + length, rng.random(4) < 0.5] = True
    return recording(hidden)


def stretches(*lengths):
    """Return frames that are hidden but for stretches of these lengths, four hidden between two."""
    hidden = [np.r_[np.zeros(length, dtype=bool), np.ones(4, dtype=bool)] for length in lengths]
    return recording(np.concatenate(hidden)[:-4, None])


@pytest.mark.parametrize(("length", "hides"), [(4, 0), (5, 0), (6, 4), (9, 4)])
def test_long_copies_have_a_frame_without_a_visible_neighbour(length, hides):
    """A stretch keeps a visible frame at each end; what is shorter than three is left out."""
    masks = hold_out_gaps(stretches(length, length, length), long_copies)
    assert {mask.sum() for mask in masks} == ({hides} if hides else set())
    assert hold_out_gaps(stretches(length, length, length))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000))
def test_held_out_gaps_hide_visible_entries_of_the_channels_with_gaps_and_leave_most(seed):
    given = with_gaps(seed)
    hidden = ~given.visible
    masks = hold_out_gaps(given)
    assert len(masks) <= N_SETS
    for mask in masks:
        assert mask.any()
        assert not (mask & hidden).any()
        assert not mask[:, ~hidden.any(axis=0)].any()
        assert (2 * mask.sum(axis=0) <= given.visible.sum(axis=0)).all()


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000))
def test_no_copy_is_longer_than_the_longest_gap_or_touches_one_between_visible_frames(seed):
    given = with_gaps(seed)
    hidden = ~given.visible
    for mask in hold_out_gaps(given):
        for d in range(4):
            gaps, copies = runs(hidden[:, d]), runs(mask[:, d])
            assert max(map(len, copies), default=0) <= max(map(len, gaps), default=0)
            for gap in gaps:
                if gap[0] > 0 and gap[-1] < len(hidden) - 1:
                    assert not mask[[gap[0] - 1, gap[-1] + 1], d].any()


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 45), st.booleans())
def test_copies_of_a_gap_that_reaches_an_end_have_visible_frames_on_one_side_only(length, at_start):
    hidden = np.zeros((60, 2), dtype=bool)
    hidden[slice(0, length) if at_start else slice(60 - length, 60)] = True
    masks = hold_out_gaps(recording(hidden))
    assert len(masks) == 2
    for mask in masks:
        visible = np.flatnonzero(~(hidden | mask)[:, 0])
        (copy,) = runs(mask[:, 0])
        assert copy[-1] < visible[0] or visible[-1] < copy[0]
        assert len(copy) == length or 4 * len(copy) > 60 - length


@pytest.mark.parametrize(("n_visible", "n_sets"), [(1, 0), (2, 0), (3, 1)])
def test_held_out_gaps_leave_two_frames(n_visible, n_sets):
    hidden = np.ones((12, 1), dtype=bool)
    hidden[4 : 4 + n_visible] = False
    masks = hold_out_gaps(recording(hidden))
    assert (len(masks) > 0) == (n_sets > 0)
    assert all((~(hidden | mask)).sum() >= 2 for mask in masks)


def test_a_gap_in_all_channels_beside_others_has_whole_frames_as_copies():
    hidden = np.zeros((100, 4), dtype=bool)
    hidden[40:45] = True
    hidden[10:18, 0], hidden[45:50, 3] = True, True  # the second continues the gap in all
    for mask in hold_out_gaps(recording(hidden)):
        (whole,) = runs(mask.all(axis=1))
        assert len(whole) == 5
        lengths = [sorted(map(len, runs(column))) for column in mask.T]
        assert lengths == [[5, 8], [5], [5], [5, 10]]


@pytest.mark.parametrize("at_start", [True, False])
def test_whole_frames_at_an_end_have_whole_frames_at_an_end_as_copies(at_start):
    hidden = np.zeros((100, 4), dtype=bool)
    hidden[:6], hidden[40:50, 0] = True, True
    hidden = hidden if at_start else hidden[::-1]
    masks = hold_out_gaps(recording(hidden))
    assert len(masks) == N_SETS
    for mask in masks:
        (whole,) = runs(mask.all(axis=1))
        assert len(whole) == 6
        seen = np.flatnonzero(~hidden.any(axis=1))
        assert whole[0] == seen[0] or whole[-1] == seen[-1]


def test_no_channel_shows_both_sides_of_a_copy_of_whole_frames_at_an_end():
    """The last frame, which one channel hides and others show, is beyond the last free in all."""
    hidden = np.zeros((95, 4), dtype=bool)
    hidden[:6], hidden[94, 0] = True, True
    for mask in hold_out_gaps(recording(hidden)):
        for d in (1, 2, 3):
            (copy,) = runs(mask[:, d])
            visible = np.flatnonzero(~(hidden | mask)[:, d])
            assert copy[-1] < visible[0] or visible[-1] < copy[0]


@pytest.mark.parametrize("n_islands", [2, 3, 4, 5])
@pytest.mark.parametrize("position", [0.0, 0.5, 0.99])
def test_a_gap_at_an_end_is_made_longer_by_the_outermost_island(n_islands, position):
    islands = 10 * np.arange(1, n_islands + 1)
    blocked = ~np.isin(np.arange(10 * (n_islands + 2)), islands)
    (held_out,) = copies_or_islands(blocked, np.arange(8), position)
    assert held_out.tolist() == [islands[0] if position < 0.5 else islands[-1]]


def test_a_copy_of_whole_frames_may_hide_half_of_those_that_all_channels_show():
    hidden = np.zeros((32, 4), dtype=bool)
    hidden[14:24], hidden[14:26, 0] = True, True
    assert (~hidden.any(axis=1)).sum() == 20
    masks = hold_out_gaps(recording(hidden))
    assert masks
    for mask in masks:
        assert mask.all(axis=1).sum() == 10


def test_of_an_odd_number_of_frames_less_than_half_are_hidden_as_a_whole():
    hidden = np.zeros((31, 4), dtype=bool)
    hidden[14:24], hidden[14:26, 0] = True, True
    assert (~hidden.any(axis=1)).sum() == 19
    masks = hold_out_gaps(recording(hidden))
    assert masks
    for mask in masks:
        assert mask.all(axis=1).sum() <= 9


def test_what_a_gap_is_shortened_to_is_half_as_long_each_time():
    free = np.zeros(200, dtype=bool)
    lengths = [len(frames) for frames in copies(free, np.arange(60, 124), 0.5)]
    assert lengths[0] == 64
    assert all(2 * after == before for before, after in pairwise(lengths))


def test_a_lost_channel_does_not_count_for_whole_frames():
    hidden = np.zeros((100, 6), dtype=bool)
    hidden[40:45], hidden[:, 5] = True, True
    masks = hold_out_gaps(recording(hidden))
    assert [int(mask.sum()) for mask in masks] == [25, 25, 25]
    hidden[10:18, 0] = True
    for mask in hold_out_gaps(recording(hidden)):
        assert len(np.flatnonzero(mask[:, :5].all(axis=1))) == 5
        assert not mask[:, 5].any()


def test_a_gap_in_all_channels_is_tried_in_each_where_no_frame_is_free_in_all():
    hidden = np.indices((120, 12)).sum(axis=0) % 10 == 0
    hidden[50:60] = True
    for mask in hold_out_gaps(recording(hidden)):
        assert (mask.sum(axis=0) > 1).all()


def test_a_gap_at_an_end_that_is_longer_in_one_channel_keeps_one_sided_copies():
    hidden = np.zeros((100, 6), dtype=bool)
    hidden[:6], hidden[:20, 5] = True, True
    first, *_ = hold_out_gaps(recording(hidden))
    np.testing.assert_array_equal(np.flatnonzero(first[:, 0]), np.arange(6, 12))
    np.testing.assert_array_equal(np.flatnonzero(first[:, 5]), np.arange(20, 40))


def test_frames_hidden_as_a_whole_have_whole_frames_as_copies():
    hidden = np.zeros((50, 3), dtype=bool)
    hidden[4:35] = True
    masks = hold_out_gaps(recording(hidden))
    assert len(masks) == N_SETS
    for mask in masks:
        assert (mask.all(axis=1) == mask.any(axis=1)).all()


def test_a_copy_is_as_long_as_the_gap_where_there_is_room():
    hidden = np.zeros((100, 2), dtype=bool)
    hidden[40:50, 0] = True
    assert [int(mask[:, 0].sum()) for mask in hold_out_gaps(recording(hidden))] == [10, 10, 10]


@pytest.mark.parametrize("n_visible", [0, 1, 2, 50])
def test_there_is_none_without_room_or_without_a_gap(n_visible):
    hidden = np.ones((50, 2), dtype=bool)
    hidden[:n_visible] = False
    assert hold_out_gaps(recording(hidden)) == []


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(3, 12))
def test_where_single_frames_are_visible_a_held_out_gap_makes_one_of_two(seed, n_visible):
    places = 1 + 2 * np.random.default_rng(seed).choice(29, n_visible, replace=False)
    hidden = np.ones((60, 2), dtype=bool)
    hidden[places] = False
    masks = hold_out_gaps(recording(hidden), copies_or_islands)
    assert masks
    for mask in masks:
        assert not (mask & hidden).any()
        assert (2 * mask.sum(axis=0) <= n_visible).all()
        assert len(runs((hidden | mask)[:, 0])) == len(runs(hidden[:, 0])) - mask[:, 0].sum()


def test_a_long_gap_has_no_copy_of_a_single_frame_among_the_islands():
    hidden = np.ones((60, 1), dtype=bool)
    hidden[[10, 20, 21, 22, 30]] = False
    alone, *_ = hold_out_gaps(recording(hidden))
    assert np.flatnonzero(alone).tolist() == [21]
    for mask in hold_out_gaps(recording(hidden), copies_or_islands):
        assert np.flatnonzero(mask).tolist() != [21]


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000))
def test_a_halved_gap_hides_half_of_each_stretch_and_borders_on_what_it_did(seed):
    given = with_gaps(seed)
    beside = np.pad(~given.visible, ((1, 1), (0, 0)), constant_values=True)
    for mask in hold_out_gaps(given):
        half = halve_gaps(~given.visible, mask)
        assert not (half & ~mask).any()
        for d in range(4):
            for stretch in runs(mask[:, d]):
                (kept,) = runs(half[stretch, d])
                assert len(kept) == max(len(stretch) // 2, 1)
                if beside[stretch[0], d]:
                    assert kept[0] == 0
                elif beside[stretch[-1] + 2, d]:
                    assert kept[-1] == len(stretch) - 1


def test_remoteness_is_the_distance_to_the_nearest_visible_frame_of_the_channel():
    hidden = np.array([[0, 1, 1, 1, 1, 1, 0, 1], [1, 1, 1, 0, 0, 0, 0, 0]], dtype=bool).T
    assert remoteness(hidden, np.zeros_like(hidden)).tolist() == [0, 0]
    within = np.zeros_like(hidden)
    within[[2, 7], 0] = True
    assert remoteness(hidden, within).tolist() == [2, 0]
    assert remoteness(hidden, hidden).tolist() == [3, 3]
    throughout = np.ones_like(hidden)
    assert remoteness(throughout, throughout).tolist() == [0, 0]


def test_each_channel_of_halved_gaps_keeps_the_side_of_its_own_gap():
    hidden = np.zeros((35, 2), dtype=bool)
    hidden[7:11, 0] = hidden[31:35, 1] = True
    held_out = np.zeros_like(hidden)
    held_out[27:31] = True
    half = halve_gaps(hidden, held_out)
    assert np.flatnonzero(half[:, 0]).tolist() == [28, 29]
    assert np.flatnonzero(half[:, 1]).tolist() == [29, 30]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(1, 12), min_size=2, max_size=10))
def test_copies_of_several_gaps_hide_at_most_fifteen_percent(lengths):
    """That is .15 of a channel's visible frames, unless one gap alone is longer."""
    visible = np.zeros(24, dtype=bool)
    hidden = np.concatenate([np.r_[visible, np.ones(length, dtype=bool)] for length in lengths])
    hidden = np.concatenate([hidden, visible])[:, None]
    for mask in hold_out_gaps(recording(hidden)):
        assert mask.sum() <= max(0.15 * (~hidden).sum(), *lengths)


def test_copies_of_successive_gaps_are_a_golden_section_of_the_recording_apart():
    hidden = np.zeros((200, 1), dtype=bool)
    for start in (50, 90, 150):
        hidden[start : start + 4] = True
    asked = []

    def watched(blocked, gap, place):
        asked.append(place)
        return copies(blocked, gap, place)

    assert len(hold_out_gaps(recording(hidden), watched)) == N_SETS
    steps = np.diff(np.reshape(asked, (N_SETS, 3)), axis=1) % 1.0
    np.testing.assert_allclose(steps, (np.sqrt(5.0) - 1.0) / 2.0)
