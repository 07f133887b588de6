import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.benchmark.filling.gaps import Episode, Gap, episodes_of, gaps_of, mask_of

MASKS = arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 5)))


@given(MASKS)
def test_the_gaps_are_the_mask(mask):
    np.testing.assert_array_equal(mask_of(gaps_of(mask), mask.shape), mask)


@given(MASKS)
def test_no_gap_goes_on_where_it_ends(mask):
    for gap in gaps_of(mask):
        for beside in {gap.start - 1, gap.stop} & set(range(len(mask))):
            assert not mask[beside, list(gap.channels)].any()


@given(MASKS)
def test_episodes_share_the_gaps_among_them_and_no_frame(mask):
    episodes = episodes_of(gaps_of(mask))
    assert sorted(gap for e in episodes for gap in e.gaps) == sorted(gaps_of(mask))
    stops = [episode.stop for episode in episodes]
    assert all(stop <= e.start for stop, e in zip(stops, episodes[1:], strict=False))


@given(MASKS, st.sampled_from([1.0, 0.5, 0.125]))
def test_a_shortened_episode_keeps_its_start_and_every_gap(mask, share):
    for episode in episodes_of(gaps_of(mask)):
        shorter = episode.shortened(share)
        assert shorter.start == episode.start
        assert len(shorter) <= len(episode)
        assert all(len(gap) >= 1 for gap in shorter.gaps)
        assert [g.channels for g in shorter.gaps] == [g.channels for g in episode.gaps]


def test_gaps_that_only_meet_are_two_episodes():
    meeting = (Gap(0, 3, (0,)), Gap(3, 5, (1,)))
    assert episodes_of(meeting) == tuple(Episode((gap,)) for gap in meeting)
