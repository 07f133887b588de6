import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.benchmark.filling.gaps import (
    Episode,
    Gap,
    count_entries,
    find_gaps,
    group_gaps,
    mask_ends,
    mask_gaps,
)

MASKS = arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 5)))


@given(MASKS)
def test_the_gaps_are_the_mask(mask):
    np.testing.assert_array_equal(mask_gaps(find_gaps(mask), mask.shape), mask)


@given(MASKS)
def test_the_entries_of_gaps_are_those_of_the_mask(mask):
    gaps = find_gaps(mask)
    assert count_entries(gaps) == mask.sum()
    assert sum(episode.n_entries for episode in group_gaps(gaps)) == mask.sum()


@given(MASKS, st.integers(0, 5))
def test_episodes_that_move_take_their_entries_along(mask, frames):
    moved = [gap for e in group_gaps(find_gaps(mask)) for gap in e.move(frames).gaps]
    later = np.pad(mask, ((frames, 0), (0, 0)))
    np.testing.assert_array_equal(mask_gaps(moved, later.shape), later)


@given(MASKS)
def test_no_gap_goes_on_where_it_ends(mask):
    for gap in find_gaps(mask):
        for beside in {gap.start - 1, gap.stop} & set(range(len(mask))):
            assert not mask[beside, list(gap.channels)].any()


@given(MASKS)
def test_ends_are_hidden_with_visible_frames_on_one_side_only(visible):
    ends = mask_ends(visible)
    for (frame, channel), is_end in np.ndenumerate(ends):
        before, after = visible[:frame, channel].any(), visible[frame + 1 :, channel].any()
        assert is_end == (not visible[frame, channel] and before != after)


@given(MASKS)
def test_episodes_share_the_gaps_among_them_and_no_frame(mask):
    episodes = group_gaps(find_gaps(mask))
    assert sorted(gap for e in episodes for gap in e.gaps) == sorted(find_gaps(mask))
    stops = [episode.stop for episode in episodes]
    assert all(stop <= e.start for stop, e in zip(stops, episodes[1:], strict=False))


@given(MASKS, st.sampled_from([1.0, 0.5, 0.125]))
def test_a_shortened_episode_keeps_its_start_and_every_gap(mask, share):
    for episode in group_gaps(find_gaps(mask)):
        shorter = episode.shorten(share)
        assert shorter.start == episode.start
        assert len(shorter) <= len(episode)
        assert all(len(gap) >= 1 for gap in shorter.gaps)
        assert [g.channels for g in shorter.gaps] == [g.channels for g in episode.gaps]


def test_gaps_that_only_meet_are_two_episodes():
    meeting = (Gap(0, 3, (0,)), Gap(3, 5, (1,)))
    assert group_gaps(meeting) == tuple(Episode((gap,)) for gap in meeting)
