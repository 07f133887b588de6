import numpy as np
import pytest
from samples import gap
from sklearn.exceptions import NotFittedError

from mocapbench.baselines import MOHGP
from mocapbench.baselines.choosing import candidates
from mocapbench.baselines.choosing.candidates import CANDIDATES, FittedCandidates
from mocapbench.baselines.choosing.jointly import Jointly
from mocapbench.datasets import Recording


def walk(name, phase=0.0, n_frames=25, n_channels=2):
    times = np.arange(n_frames) / 25
    angles = 2 * np.pi * times[:, None] + phase + np.arange(n_channels)
    channels = tuple(f"channel {k}" for k in range(n_channels))
    return Recording(name, times, np.sin(angles), channels, ("",) * n_channels)


TRAINING = [walk("one"), gap(walk("two", 0.2), 3, 5)]


@pytest.fixture(scope="module")
def model():
    return Jointly(MOHGP(n_restarts=1, max_iter=15)).fit(TRAINING)


def test_it_is_the_process_given_all_recordings_together(model):
    """Up to the one iteration: the posterior is that of its parameters."""
    given = gap(walk("new", 0.1), 8, 16)
    (filled,) = model.impute([given])
    together = MOHGP(n_restarts=1, max_iter=15).fit([given, *TRAINING]).impute([given])[0]
    truth = walk("new", 0.1).values
    hidden = ~given.visible
    assert np.abs(filled.mean - truth)[hidden].max() < 0.1
    np.testing.assert_allclose(filled.mean, together.mean, atol=0.1)
    assert (filled.variance[hidden] > 0).all()


def test_with_other_recordings_parameters_stay(model):
    """Even if they are complete."""
    before = model.process_.parameters_.flat.copy()
    others = [walk("three", 0.3), walk("four", 0.4)]
    again = model.with_recordings(others)
    assert [recording.name for recording in model.recordings_] == ["one", "two"]
    np.testing.assert_array_equal(again.process_.parameters_.flat, before)
    assert [recording.name for recording in again.recordings_] == ["three", "four"]
    model.impute([gap(walk("new"), 8, 16)])
    np.testing.assert_array_equal(model.process_.parameters_.flat, before)


def test_fit_forgets_what_was_learnt_before(model):
    three = gap(walk("three", 0.9), 8, 16)
    others = [three.with_values(5.0 * three.values**3)]
    fresh = Jointly(MOHGP(n_restarts=1, max_iter=15)).fit(others)
    again = Jointly(MOHGP(n_restarts=1, max_iter=15)).fit(TRAINING).fit(others)
    np.testing.assert_array_equal(again.process_.parameters_.flat, fresh.process_.parameters_.flat)


def test_company_does_not_matter(model):
    given = [gap(walk("new", 0.1), 8, 16), gap(walk("other", 0.5), 2, 6)]
    alone, together = model.impute(given[:1])[0], model.impute(given)[0]
    np.testing.assert_array_equal(alone.mean, together.mean)
    np.testing.assert_array_equal(alone.variance, together.variance)


def test_a_recording_that_was_learnt_from_is_filled_as_given(model):
    """What `fit` saw of it does not count."""
    (filled,) = model.impute([gap(walk("one"), 8, 16)])
    assert (filled.variance[8:16] > 1e-9).all()


def test_the_recording_to_fill_comes_first():
    """To it others are registered, of several with as many hidden entries."""
    orders = []

    class Watched(MOHGP):
        def fit(self, recordings):
            orders.append([recording.name for recording in recordings])
            return super().fit(recordings)

    model = Jointly(Watched(n_restarts=1, max_iter=2)).fit(TRAINING)
    model.impute([gap(walk("new"), 8, 16), gap(walk("two"), 8, 16)])
    assert orders == [["one", "two"], ["new", "one", "two"], ["two", "one"]]


def test_it_learns_from_recordings_to_fill():
    with pytest.raises(ValueError, match="a recording with hidden entries among those to learn"):
        Jointly(MOHGP()).fit([walk("one"), walk("two")])


def test_recordings_that_would_take_long_are_refused(model):
    large = [walk(name, n_frames=100, n_channels=50) for name in ("one", "two")]
    with pytest.raises(ValueError, match=r"at most 1.8e\+11, .* got 3.8e\+11 and 3e\+06"):
        Jointly(MOHGP()).fit(large)
    with pytest.raises(ValueError, match=r"of frames to 3e\+06, got 2.7e\+07 and 3.4e\+06"):
        model.impute([gap(walk("long", n_frames=150), 8, 16)])


@pytest.mark.parametrize("name", ["mohgp", "mohgp-registered"])
def test_a_candidate_fitted_anew_leaves_the_first_as_it_is(name, monkeypatch):
    monkeypatch.setattr(candidates, "CANDIDATES", {name: CANDIDATES[name]})
    short = [recording.frames(np.arange(12)) for recording in TRAINING]
    first = FittedCandidates.of(short)
    given = gap(short[0], 5, 8)
    before = first.means(given)[name]
    anew = first.anew([walk("three", 0.3, n_frames=12)])
    assert [recording.name for recording in anew.models[name].recordings_] == ["three"]
    assert [recording.name for recording in first.models[name].recordings_] == ["one", "two"]
    assert anew.models[name].process_ is first.models[name].process_
    np.testing.assert_array_equal(first.means(given)[name], before)


def test_channels_are_those_of_fit(model):
    given = gap(walk("new"), 8, 16)
    with pytest.raises(NotFittedError):
        Jointly(MOHGP()).impute_uncalibrated([given])
    for answer in (model.impute_uncalibrated, model.impute):
        with pytest.raises(ValueError, match="expected channels"):
            answer([given.select(given.channels[::-1])])
