import numpy as np
import pytest

from mocapbench.baselines.k_means import KMeans
from mocapbench.datasets import Recording

CHANNELS, UNITS = ("knee.rx", "hip.rx"), ("deg", "deg")


def _gait(name, amplitude, n_frames=90, period=30, phase=0.0):
    angle = 2 * np.pi * np.arange(n_frames) / period + phase
    values = amplitude * np.column_stack([np.cos(angle), np.sin(2 * angle)])
    return Recording(name, np.arange(n_frames) / 30, values, CHANNELS, UNITS)


GAITS = [_gait(f"walk {k}", 10.0 + k) for k in range(3)]
GAITS += [_gait(f"run {k}", 40.0 + k, period=20) for k in range(2)]


def _partition(labels):
    return {frozenset(np.flatnonzero(labels == label)) for label in set(labels)}


def test_gaits_of_one_kind_are_together():
    labels = KMeans(2, random_state=0).fit(GAITS).labels_
    assert _partition(labels) == {frozenset({0, 1, 2}), frozenset({3, 4})}


def test_a_cycle_is_what_recurs_whatever_its_length():
    slow, fast = (
        KMeans(1, random_state=0)
        .fit([_gait("slow", 10.0, period=30), _gait("fast", 10.0, period=20)])
        .cycles_
    )
    np.testing.assert_allclose(slow, fast, atol=0.5)
    angle = 2 * np.pi * np.arange(32) / 32
    np.testing.assert_allclose(slow[:, 0], 10.0 * np.cos(angle), atol=0.5)


def test_nothing_aligns_a_recording_that_starts_at_another_phase():
    """The weakness that it is here to show."""
    turned = [_gait(f"turned {k}", 10.0 + k, phase=np.pi) for k in range(3)]
    labels = KMeans(2, random_state=0).fit([*GAITS[:3], *turned]).labels_
    assert _partition(labels) == {frozenset({0, 1, 2}), frozenset({3, 4, 5})}


def test_hidden_entries_are_bridged_and_hidden_channels_are_average():
    mask = np.zeros((90, 2), dtype=bool)
    mask[3:12:4, 0] = True
    mask[:, 1] = True
    cycles = KMeans(2, random_state=0).fit([*GAITS[:4], GAITS[4].hide(mask)]).cycles_
    whole = KMeans(2, random_state=0).fit(GAITS).cycles_
    np.testing.assert_allclose(cycles[4, :, 0], whole[4, :, 0], atol=2.5)
    average = np.concatenate([gait.values[:, 1] for gait in GAITS[:4]]).mean()
    np.testing.assert_allclose(cycles[4, :, 1], average, atol=1e-12)


def test_there_are_no_more_clusters_than_recordings():
    assert len(set(KMeans(9, random_state=0).fit(GAITS).labels_)) == len(GAITS)


def test_a_channel_that_nobody_shows_is_refused():
    hidden = np.repeat([[False, True]], 90, axis=0)
    with pytest.raises(ValueError, match=r"none of \['hip.rx'\]"):
        KMeans().fit([gait.hide(hidden) for gait in GAITS])
