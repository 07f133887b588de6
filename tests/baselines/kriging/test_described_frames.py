import numpy as np
import pytest

from mocapbench.baselines.kriging.described_frames import DescribedFrames, choose_near


@pytest.fixture
def described():
    rng = np.random.default_rng(0)
    return [
        DescribedFrames(rng.normal(size=(n, 3)), np.arange(n), np.arange(n) % 4) for n in (40, 5)
    ]


@pytest.mark.parametrize(("most", "n_kept"), [(100, 40), (30, 40), (15, 25), (0, 10)])
def test_all_frames_of_the_recording_are_kept_and_those_of_others_that_are_alike(
    described, most, n_kept
):
    frames, wanted = described
    kept = choose_near(frames, wanted, 2, most)
    assert len(kept) == len(set(kept)) == n_kept
    assert set(np.flatnonzero(frames.recording == 2)) <= {*kept}
    apart = np.linalg.norm(wanted.description[:, None] - frames.description, axis=2)
    others = np.flatnonzero(frames.recording != 2)
    ranks = apart[:, others].argsort(axis=1).argsort(axis=1).min(axis=0)
    chosen = np.isin(others, kept)
    assert max(ranks[chosen], default=0) <= min(ranks[~chosen], default=np.inf)


def test_a_rare_frame_that_is_wanted_has_its_nearest():
    rng = np.random.default_rng(0)
    places = np.append(rng.normal(size=(60, 2)), [[50.0, 50.0]], axis=0)
    frames = DescribedFrames(places, np.arange(61), np.repeat([0, 1], [5, 56]))
    wanted = DescribedFrames(
        np.append(rng.normal(size=(20, 2)), [[40.0, 40.0]], axis=0),
        np.arange(21),
        np.zeros(21, int),
    )
    assert 60 in choose_near(frames, wanted, 0, 30)


def test_the_order_of_frames_does_not_change_which_are_kept(described):
    frames, wanted = described
    order = np.random.default_rng(1).permutation(40)
    kept = choose_near(frames.at(order), wanted, 1, 10)
    assert {*order[kept]} == {*choose_near(frames, wanted, 1, 10)}
