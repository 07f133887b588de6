import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.gaps import gaps_of
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.trials.making import make_trials
from mocapbench.datasets import Recording

N_FRAMES = 200
BLOCKS = st.lists(
    st.tuples(st.integers(0, N_FRAMES), st.integers(1, 30), st.integers(0, 2)),
    min_size=1,
    max_size=4,
)


def question(blocks):
    target = np.zeros((N_FRAMES, 3), dtype=bool)
    for start, length, channel in blocks:
        target[min(start, N_FRAMES - 1) : start + length, channel] = True
    values = np.arange(3.0 * N_FRAMES).reshape(N_FRAMES, 3)
    whole = Recording("r", np.arange(N_FRAMES) / 10, values, ("a", "b", "c"), ("", "", ""))
    return GapQuestion(whole.hide(target), target)


@settings(deadline=None)
@given(BLOCKS)
def test_trials_know_the_truth_and_hide_it(blocks):
    asked = question(blocks)
    for trial in make_trials(asked, np.random.default_rng(0)):
        target = trial.question.target
        first = round(trial.question.given.times[0] * 10)
        whole = np.arange(3.0 * N_FRAMES).reshape(N_FRAMES, 3)[first : first + len(target)]
        np.testing.assert_array_equal(trial.truth, whole[target])
        assert not trial.question.given.visible[target].any()
        places = np.sort(np.concatenate(trial.units))
        np.testing.assert_array_equal(places, np.arange(target.sum()))
        seen = trial.question.given.visible
        np.testing.assert_array_equal(trial.question.given.values[seen], whole[seen])


@settings(deadline=None)
@given(BLOCKS)
def test_every_trial_gap_has_the_shape_of_a_real_one(blocks):
    asked = question(blocks)
    real = {(len(gap), gap.channels) for gap in gaps_of(asked.target)}
    for trial in make_trials(asked, np.random.default_rng(0)):
        if trial.share == 1.0:
            made = {(len(gap), gap.channels) for gap in gaps_of(trial.question.target)}
            assert made <= real


@settings(deadline=None)
@given(st.integers(4, 12), st.integers(1, 2), st.integers(0, 100))
def test_no_two_trials_are_alike_however_short_the_recording(n_frames, length, seed):
    values = np.arange(2.0 * n_frames).reshape(n_frames, 2)
    target = np.zeros((n_frames, 2), dtype=bool)
    target[1 : 1 + length, 0] = True
    whole = Recording("r", np.arange(n_frames) / 10, values, ("a", "b"), ("", ""))
    trials = make_trials(GapQuestion(whole.hide(target), target), np.random.default_rng(seed))
    hidden = [trial.question.target.tobytes() for trial in trials]
    assert len(set(hidden)) == len(hidden)


def test_gaps_at_the_ends_are_tried_at_the_ends():
    asked = question([(0, 10, 0), (190, 10, 1)])
    for trial in make_trials(asked, np.random.default_rng(0)):
        gaps = gaps_of(trial.question.target)
        assert {(gap.start, gap.channels) for gap in gaps if gap.start == 0} == {(0, (0,))}
        assert {gap.channels for gap in gaps if gap.stop == len(trial.question.target)} == {(1,)}


def test_gaps_get_equally_many_copies():
    asked = question([(20, 5, 0), (80, 25, 1), (150, 10, 2)])
    trials = make_trials(asked, np.random.default_rng(0))
    lengths = [len(unit) for trial in trials for unit in trial.units]
    counts = [lengths.count(length) for length in (5, 25, 10)]
    assert max(counts) - min(counts) <= 1


def test_a_gap_longer_than_any_visible_stretch_is_shortened():
    asked = question([(60, 110, 0)])
    trials = make_trials(asked, np.random.default_rng(0))
    assert trials
    assert {trial.share for trial in trials} == {0.5}


def test_there_is_no_trial_without_room():
    asked = question([(1, 198, 0)])
    assert make_trials(asked, np.random.default_rng(0)) == []


@pytest.mark.parametrize("seed", [0, 1])
def test_the_same_seed_makes_the_same_trials(seed):
    asked = question([(20, 5, 0)])
    one, two = (make_trials(asked, np.random.default_rng(seed)) for _ in range(2))
    for first, second in zip(one, two, strict=True):
        np.testing.assert_array_equal(first.question.target, second.question.target)


def test_no_gap_is_shortened_that_fits_once_another_trial_has_the_room():
    """Beside the copy of a long gap there may be no room for a second, but alone there is."""
    asked = question([(10, 8, 0), (50, 30, 1), (120, 30, 2)])
    for seed in range(10):
        trials = make_trials(asked, np.random.default_rng(seed))
        assert {trial.share for trial in trials} == {1.0}
        assert {len(unit) for trial in trials for unit in trial.units} == {8, 30}


def test_a_gap_at_an_end_takes_no_trial_from_the_others():
    """Beside the copy at the end, a long gap has room only if it is shortened."""
    target = np.zeros((120, 3), dtype=bool)
    target[:8, 0] = target[50:90, 1] = True
    values = np.arange(360.0).reshape(120, 3)
    whole = Recording("r", np.arange(120) / 10, values, ("a", "b", "c"), ("", "", ""))
    for seed in range(5):
        trials = make_trials(GapQuestion(whole.hide(target), target), np.random.default_rng(seed))
        copies = [episode for trial in trials for episode in trial.originals]
        channels = [gap.channels for episode in copies for gap in episode.gaps]
        assert channels.count((1,)) >= len(trials) // 2 > 0


def test_a_repeated_trial_is_not_the_end():
    """Little room in two channels makes copies alike, but others are still to be had."""
    target = np.zeros((400, 3), dtype=bool)
    target[100:140, 0] = target[200:230, 2] = target[300:306, 1] = True
    hidden = target.copy()
    hidden[:60, 0] = hidden[160:, 0] = hidden[:60, 1] = hidden[160:, 1] = True
    values = np.arange(1200.0).reshape(400, 3)
    whole = Recording("r", np.arange(400) / 10, values, ("a", "b", "c"), ("", "", ""))
    for seed in range(5):
        trials = make_trials(GapQuestion(whole.hide(hidden), target), np.random.default_rng(seed))
        assert len(trials) > 5


def test_a_trial_that_ends_in_a_gap_may_end_anywhere_in_the_last_third():
    asked = question([(170, 30, 0)])
    trials = [t for seed in range(5) for t in make_trials(asked, np.random.default_rng(seed))]
    ends = [len(trial.question.target) for trial in trials]
    assert {trial.share for trial in trials} == {1.0}
    assert 133 <= min(ends) < 145
    assert 160 < max(ends) < 170
