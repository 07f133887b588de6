import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.trials.making import make_trials
from mocapbench.benchmark.filling.trials.places import places_of
from mocapbench.datasets import Recording


def question(n_frames, *gaps, rng=None):
    """Ask for frames of two channels of one random walk, with a little noise."""
    rng = np.random.default_rng(0) if rng is None else rng
    walk = np.cumsum(rng.normal(size=n_frames))[:, None]
    target = np.zeros((n_frames, 2), dtype=bool)
    for first, stop in gaps:
        target[first:stop] = True
    values = walk + rng.normal(0.0, 0.05, target.shape)
    times = np.arange(n_frames) / 30
    return GapQuestion(Recording("r", times, values, ("a", "b"), ("mm",) * 2).hide(target), target)


def spans_of(trials):
    """Return the frames of each trial gap, as trials hide them."""
    for trial in trials:
        first = round(trial.question.given.times[0] * 30)
        frames = first + np.nonzero(trial.question.target)[0]
        for gap in trial.units:
            yield set(range(frames[gap].min() - 1, frames[gap].max() + 2))


GAPS = st.lists(st.tuples(st.integers(0, 190), st.integers(1, 60)), min_size=1, max_size=3)


@settings(deadline=None, max_examples=50)
@given(GAPS)
def test_a_place_is_a_trial_gap_with_those_that_share_frames_with_it(gaps):
    trials = make_trials(question(200, *((a, a + n) for a, n in gaps)), np.random.default_rng(0))
    spans, places = list(spans_of(trials)), places_of(trials)
    firsts = []
    for place in range(len(set(places.tolist()))):
        here = [span for span, at in zip(spans, places, strict=True) if at == place]
        firsts.append(min(here, key=max))
        assert all(firsts[-1] & span for span in here)
    assert sum(map(len, firsts)) == len(set().union(*firsts))


def test_trial_gaps_of_a_short_recording_are_at_two_places():
    trials = make_trials(question(200, (70, 130)), np.random.default_rng(0))
    assert len(trials) > 10
    assert set(places_of(trials).tolist()) == {0, 1}


def test_trial_gaps_of_a_long_recording_are_nearly_all_at_places_of_their_own():
    trials = make_trials(question(1500, (700, 715)), np.random.default_rng(0))
    places = places_of(trials)
    assert len(set(places.tolist())) > 0.9 * len(places) > 40
