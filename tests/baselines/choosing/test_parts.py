"""Gaps in all channels, and others, are held out and weighed apart."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import BestOf, LinearImputer
from mocapbench.baselines.choosing.parts import EVERYTHING, parts_of
from mocapbench.basics.mask_runs import whole_gaps
from mocapbench.datasets import Recording


def recording(hidden, units=None):
    n_frames, n_channels = hidden.shape
    names = tuple(f"c{d}" for d in range(n_channels))
    values = np.arange(hidden.size, dtype=float).reshape(hidden.shape)
    units = units or ("mm",) * n_channels
    return Recording("r", np.arange(n_frames) / 100, values, names, units).hide(hidden)


def scattered(seed, share=0.4):
    return np.random.default_rng(seed).random((40, 5)) < share


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.0, 0.95))
def test_every_entry_belongs_to_the_part_of_its_unit(seed, share):
    hidden = scattered(seed, share)
    assigned = np.full(hidden.shape, "")
    for name, part in parts_of(recording(hidden, ("deg", "mm", "deg", "mm", "mm"))).items():
        assigned[part.entries(hidden)] = name[0]
    assert (assigned[:, [0, 2]] == "d")[hidden[:, [0, 2]]].all()
    assert (assigned[:, [1, 3, 4]] == "m")[hidden[:, [1, 3, 4]]].all()
    assert EVERYTHING.entries(hidden).all()


def test_gaps_of_one_kind_are_a_part_for_each_unit():
    whole, limb = np.zeros((40, 4), dtype=bool), np.zeros((40, 4), dtype=bool)
    whole[10:15], limb[20:30, :2] = True, True
    units = ("deg", "deg", "deg", "mm")
    assert [*parts_of(recording(whole, units))] == ["deg", "mm"]
    assert [*parts_of(recording(limb, units))] == ["deg", "mm"]
    parts = parts_of(recording(whole | limb, units))
    assert [*parts] == ["deg", "deg, whole frames", "mm", "mm, whole frames"]
    np.testing.assert_array_equal(
        np.flatnonzero(parts["deg, whole frames"].entries(whole | limb)[:, 0]), np.arange(10, 15)
    )


def test_channels_hidden_throughout_are_a_part_where_there_are_other_gaps():
    lost, limb = np.zeros((40, 4), dtype=bool), np.zeros((40, 4), dtype=bool)
    lost[:, 1], limb[20:30, :1] = True, True
    units = ("deg", "deg", "deg", "mm")
    assert [*parts_of(recording(lost, units))] == ["deg", "mm"]
    parts = parts_of(recording(lost | limb, units))
    assert [*parts] == ["deg", "deg, whole channels", "mm"]
    np.testing.assert_array_equal(parts["deg, whole channels"].entries(lost | limb), lost)
    assert not (parts["deg"].entries(lost | limb) & lost).any()
    np.testing.assert_array_equal(parts["deg, whole channels"].widely.entries(lost)[:, :3], True)
    lost[5:9] = True  # whole frames, too, but nothing besides
    assert [*parts_of(recording(lost, units))] == ["deg", "deg, whole channels", "mm"]


def test_what_is_hidden_in_all_channels_by_chance_is_no_gap_of_all():
    hidden = np.zeros((40, 3), dtype=bool)
    hidden[10:14, 0], hidden[12:18, 1], hidden[11:15, 2] = True, True, True
    assert whole_gaps(hidden) == []
    hidden[30:33] = True
    hidden[29, 2] = True  # it begins earlier in one of three
    np.testing.assert_array_equal(whole_gaps(hidden), [[30, 31, 32]])


@pytest.mark.slow
def test_gaps_in_channels_do_not_choose_what_fills_whole_frames():
    """Channels follow each other closely, so that others tell a hidden one, if any is visible."""
    rng, times = np.random.default_rng(3), np.arange(360)[:, None] / 100
    steps = 0.7 * np.arange(6)
    along = 1200 * times + 40 * np.sin(2.2 * np.pi * times + steps)
    across = 60 * np.cos(2.2 * np.pi * times + steps) + 100 * np.arange(6)
    up = 900 + 30 * np.sin(4.4 * np.pi * times + steps)
    values = np.stack([along, across, up], axis=2).reshape(360, 18)
    values += 0.3 * rng.normal(size=values.shape)
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[250:256], hidden[60:90, 3:6], hidden[150:190, 6:12] = True, True, True
    hidden[:12, 12:15], hidden[340:, 15:] = True, True
    truth = Recording("r", times[:, 0], values, tuple(map(str, range(18))), ("mm",) * 18)
    given = truth.hide(hidden)
    model = BestOf().fit([given])
    weights = model.weights([given])[0]["mm, whole frames"]
    assert weights["pca-regression"] < 0.01
    (filled,), (linear,) = model.impute([given]), LinearImputer().fit([given]).impute([given])
    errors = [np.sqrt(np.mean((p.mean - values)[250:256] ** 2)) for p in (filled, linear)]
    assert errors[0] < errors[1]
