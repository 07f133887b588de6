"""The mixture of linear dynamical systems as a clusterer."""

import numpy as np
import pytest

from mocapbench.baselines.lgssm import LGSSM
from mocapbench.datasets import Recording

CHANNELS, UNITS = ("knee.rx", "hip.rx"), ("deg", "deg")


def gait(name, period, phase, n_frames=60):
    angle = 2 * np.pi * np.arange(n_frames) / period + phase
    values = 10.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    return Recording(name, np.arange(n_frames) / 30, values, CHANNELS, UNITS)


GAITS = [gait(f"slow {k}", 40, k, 60 + 3 * k) for k in range(4)]
GAITS += [gait(f"fast {k}", 12, k, 50 + k) for k in range(3)]
TRUE = {frozenset({0, 1, 2, 3}), frozenset({4, 5, 6})}


def partition(labels):
    return {frozenset(np.flatnonzero(labels == label)) for label in set(labels)}


def test_recordings_with_the_same_dynamics_are_together_at_any_phase():
    labels = LGSSM(2, n_states=2, random_state=0).fit(GAITS).labels_
    assert partition(labels) == TRUE


def test_labels_are_in_the_order_given():
    model = LGSSM(2, n_states=2, random_state=0)
    order = [5, 0, 6, 3, 1, 4, 2]
    one = model.fit(GAITS).labels_
    np.testing.assert_array_equal(model.fit([GAITS[k] for k in order]).labels_, one[order])


def test_hidden_entries_are_integrated_out():
    rng = np.random.default_rng(0)
    given = [g.hide(rng.random(g.values.shape) < 0.3) for g in GAITS]
    assert partition(LGSSM(2, n_states=2, random_state=0).fit(given).labels_) == TRUE


def test_the_run_with_the_highest_objective_is_kept():
    model = LGSSM(3, n_states=2, n_restarts=4, random_state=1).fit(GAITS)
    assert model.restart_objectives_.shape == (4,)
    assert model.objective_[-1] == model.restart_objectives_.max()
    assert (np.diff(model.objective_) >= 0).all()


def test_there_are_no_more_clusters_than_recordings():
    assert len(set(LGSSM(20, n_states=2, random_state=0).fit(GAITS).labels_)) <= len(GAITS)


@pytest.mark.filterwarnings("ignore:expected training data")
def test_a_single_frame_a_still_recording_and_a_hidden_channel_are_clustered():
    still = gait("still", 10, 0.0).with_values(np.full((60, 2), 3.0))
    half = np.repeat([[False, True]], 60, axis=0)
    given = [*GAITS, still, gait("half", 12, 0.0).hide(half), gait("one", 12, 0.0, n_frames=1)]
    labels = LGSSM(8, n_states=4, random_state=0).fit(given).labels_
    assert labels.shape == (10,)


def test_a_channel_that_nobody_shows_is_refused():
    hidden = [g.hide(np.repeat([[False, True]], len(g.times), axis=0)) for g in GAITS]
    with pytest.raises(ValueError, match=r"none of \['hip.rx'\]"):
        LGSSM().fit(hidden)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"n_styles": 0}, "expected n_styles to be an integer of at least 1, got 0"),
        ({"n_restarts": "3"}, "expected n_restarts to be an integer of at least 1, got '3'"),
        ({"tol": 0.0}, "expected tol to be a finite positive number, got 0.0"),
        ({"random_state": -1}, "expected random_state to be None, an integer"),
    ],
)
def test_bad_parameters_are_refused(parameters, message):
    with pytest.raises(ValueError, match=message):
        LGSSM(**parameters).fit(GAITS)
