import numpy as np
import pytest

from mocapbench.baselines.kriging.channel_process import TYPICAL, ChannelPairs
from mocapbench.baselines.kriging.described_frames import (
    DescribedFrames,
    choose_evenly,
    choose_from_both,
)
from mocapbench.baselines.kriging.held_out_stretches import (
    HeldOutStretches,
    add_noise,
    learn_parameters,
    stretch_numbers,
)

TIMES = np.concatenate([np.arange(60), np.arange(30)]) / 30
RECORDING = np.repeat([0, 4], [60, 30])


def test_stretches_last_as_long_as_asked_and_are_of_one_recording():
    stretch = stretch_numbers(TIMES, RECORDING, 0.5)
    assert [int((stretch == number).sum()) for number in np.unique(stretch)] == [15] * 6
    assert set(stretch[RECORDING == 0]).isdisjoint(stretch[RECORDING == 4])


def test_stretches_are_shorter_where_there_would_be_fewer_than_four():
    assert stretch_numbers(TIMES, RECORDING, 100.0).max() + 1 >= 4


def test_rows_are_spread_evenly():
    one = np.zeros(11, dtype=int)
    np.testing.assert_array_equal(choose_evenly(one, 3), [0, 5, 10])
    np.testing.assert_array_equal(choose_evenly(one, 1), [5])
    np.testing.assert_array_equal(choose_evenly(one, 20), np.arange(11))
    assert not choose_evenly(one[:0], 3).size


def test_every_recording_gives_its_share_of_rows_wherever_it_stands():
    lengths = {0: 60, 1: 30, 2: 7}
    rng = np.random.default_rng(0)
    for most in (1, 10, 50):
        taken = set()
        for order in ([0, 1, 2], [2, 0, 1], [1, 2, 0]):
            numbers = rng.permutation(3)  # what a recording is called
            recording = np.repeat(numbers[order], [lengths[one] for one in order])
            frame = np.concatenate([np.arange(lengths[one]) for one in order])
            called = {number: one for one, number in enumerate(numbers.tolist())}
            some = choose_evenly(recording, most)
            chosen = [(called[recording[row]], frame[row]) for row in some]
            assert [sum(one == each for each, _ in chosen) for one in lengths] == [
                -(-most * length // 97) for length in lengths.values()
            ]
            taken.add(frozenset(chosen))
        assert len(taken) == 1


def test_frames_are_taken_of_the_recording_and_of_all_others():
    np.testing.assert_array_equal(choose_from_both(RECORDING, 4, 2), [60, 89, 0, 59])
    np.testing.assert_array_equal(choose_from_both(RECORDING, 9, 3), choose_evenly(RECORDING, 3))


def test_nothing_beside_what_is_learnt_predicts_better():
    """Of what priors and held-out gaps say together."""
    rng = np.random.default_rng(0)
    phase = np.cumsum(rng.uniform(0.0, 0.3, 90))
    description = np.column_stack([np.sin(phase), np.cos(phase)])
    frames = DescribedFrames(description, np.r_[np.arange(60), np.arange(30)], RECORDING)
    values = description[:, [0]] ** 2 + 0.1 * rng.normal(size=(90, 1))
    values = (values - values.mean()) / values.std()
    stretch = stretch_numbers(TIMES, RECORDING, 0.3)
    pairs = ChannelPairs.of(frames, frames)
    weight = (stretch.max() + 1) / 90

    def score(parameters):
        left_out = HeldOutStretches(add_noise(pairs, parameters), values, stretch)
        return weight * left_out.score + 0.5 * np.sum((parameters - TYPICAL) ** 2)

    found = learn_parameters(pairs, values, stretch, TYPICAL, weight)
    assert score(found) < score(TYPICAL)
    for _ in range(5):
        assert score(found + 0.3 * rng.normal(size=6)) > score(found) - 1e-3


def test_noise_is_on_the_diagonal():
    pairs = ChannelPairs.of(*[DescribedFrames(np.zeros((3, 1)), np.arange(3), np.zeros(3))] * 2)
    added = add_noise(pairs, TYPICAL) - pairs.covariance(TYPICAL)
    np.testing.assert_allclose(added, np.exp(2 * TYPICAL[-1]) * np.eye(3), atol=2e-6)


@pytest.mark.parametrize("seed", range(3))
def test_a_copy_of_frames_changes_no_stretch(seed):
    order = np.random.default_rng(seed).permutation(90)
    one, other = (
        stretch_numbers(TIMES, RECORDING, 0.4),
        stretch_numbers(TIMES[order], RECORDING[order], 0.4),
    )
    np.testing.assert_array_equal(one[order], other)
