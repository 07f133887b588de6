from functools import partial

import numpy as np
import pytest

from mocapbench.baselines import (
    GPDM,
    GPLVM,
    KNN,
    NN,
    AlignedWindow,
    BestOf,
    PoseKriging,
    PoseViterbi,
)
from mocapbench.baselines.choosing import candidates
from mocapbench.baselines.common.pose_units import from_pose_units, in_pose_units, pose_factors
from mocapbench.datasets import Recording

CHANNELS = ("lfemur.rx", "ltibia.rx", "rfemur.rx", "rtibia.rx", "root.tx", "root.ty")
ANGLES = np.arange(6) < 4
PER_FILE = np.where(ANGLES, np.pi / 180, 1e-3)
"""Radians in a degree, and metres in a millimetre."""


def walk(name, start, n_frames, style):
    """Return a walk whose angles are in degrees, and the place of the body in millimetres."""
    frames = np.arange(n_frames)
    phases = [2 * np.pi * (start + shift + frames) / 21.3 for shift in (0, 10.65)]
    legs = [[30 * np.sin(p), 40 * np.exp(style * np.cos(p - 1))] for p in phases]
    rng = np.random.default_rng(n_frames)
    body = [41.0 * frames * (1 + style), 900 + 20 * np.sin(2 * phases[0])]
    values = np.column_stack([*legs[0], *legs[1], *body])
    values += rng.normal(scale=np.where(ANGLES, 1.0, 5.0), size=values.shape)
    units = ("deg",) * 4 + ("mm",) * 2
    return Recording(name, frames / 30, values, CHANNELS, units)


def in_other_units(recording):
    """Return the recording in radians and metres."""
    units = ("rad",) * 4 + ("m",) * 2
    values = recording.values * PER_FILE
    return Recording(recording.name, recording.times, values, CHANNELS, units)


TRAINING = [walk("one", 0, 60, 0.3), walk("two", 5, 55, 0.5)]
WHOLE = walk("new", 2, 40, 0.4).hide((np.isin(np.arange(40), np.arange(14, 22)))[:, None])
ENTRIES = walk("new", 2, 40, 0.4).hide(
    np.isin(np.arange(40), np.arange(14, 22))[:, None] & np.isin(np.arange(6), [1, 2, 5])
)
SHORT_SEARCH = {"n_latent": 2, "max_iter": 2, "fill_iter": 3, "random_state": 0}
MODELS = {
    "pose-kriging": (PoseKriging, WHOLE),
    "pose-kriging, own course": (partial(PoseKriging, least_explained=1.0), WHOLE),
    "pose-viterbi": (PoseViterbi, WHOLE),
    "gpdm": (partial(GPDM, subject_offset=1.0, **SHORT_SEARCH), WHOLE),
    "gplvm": (partial(GPLVM, **SHORT_SEARCH), WHOLE),
    "knn": (KNN, WHOLE),
    "knn, entries": (KNN, ENTRIES),
    "nn": (NN, ENTRIES),
    "nn, weights": (partial(NN, dict(zip(CHANNELS, (1, 2, 3, 4, 5, 6), strict=True))), ENTRIES),
    "aligned-window": (AlignedWindow, WHOLE),
}


def assert_alike(model, other, recording, rtol):
    """Compare what models fitted to the same in different units predict."""
    (one,), (two,) = model.impute([recording]), other.impute([in_other_units(recording)])
    np.testing.assert_allclose(two.mean / PER_FILE, one.mean, rtol=rtol)
    np.testing.assert_array_equal(
        two.mean[recording.visible], in_other_units(recording).values[recording.visible]
    )
    assert (one.variance is None) == (two.variance is None)
    if one.variance is not None:
        np.testing.assert_allclose(two.variance / PER_FILE**2, one.variance, rtol=rtol)


@pytest.mark.parametrize("name", MODELS)
def test_results_do_not_depend_on_units(name):
    new, recording = MODELS[name]
    model, other = new().fit(TRAINING), new().fit([in_other_units(r) for r in TRAINING])
    assert_alike(model, other, recording, 1e-6)


@pytest.mark.parametrize("recording", [WHOLE, ENTRIES])
def test_neither_do_those_of_several_models(recording, monkeypatch):
    names = ("linear", "pchip", "low-rank", "nn", "aligned-window", "pose-kriging")
    few = {name: candidates.CANDIDATES[name] for name in names}
    monkeypatch.setattr(candidates, "CANDIDATES", few)
    model, other = BestOf().fit(TRAINING), BestOf().fit([in_other_units(r) for r in TRAINING])
    assert_alike(model, other, recording, 1e-6)


def test_samples_and_poses_are_in_the_units_of_the_channels():
    model = GPDM(**SHORT_SEARCH).fit(TRAINING)
    other = GPDM(**SHORT_SEARCH).fit([in_other_units(r) for r in TRAINING])
    for one, two in (
        (model.sample(WHOLE.times[:8], 2, 0), other.sample(WHOLE.times[:8], 2, 0)),
        (model.poses(np.ones((3, 2))), other.poses(np.ones((3, 2)))),
    ):
        # Chains of Hybrid Monte Carlo enlarge the rounding of the factors.
        np.testing.assert_allclose(two / PER_FILE, one, rtol=1e-4)


def test_a_matched_path_is_in_the_units_of_the_channels():
    model = PoseViterbi().fit(TRAINING)
    other = PoseViterbi().fit([in_other_units(r) for r in TRAINING])
    matched = other.match(in_other_units(WHOLE))
    np.testing.assert_allclose(matched / PER_FILE, model.match(WHOLE), rtol=1e-12)
    residual = other.residual(in_other_units(WHOLE)) / PER_FILE
    np.testing.assert_allclose(residual, model.residual(WHOLE), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("unit", ["deg", "rad", "mm", "cm", "m", "", "sd"])
def test_with_one_unit_alone_nothing_changes(unit):
    recording = Recording("one", WHOLE.times, WHOLE.values, CHANNELS, (unit,) * 6)
    assert in_pose_units(recording) is recording
    assert pose_factors(recording.units).tolist() == [1.0] * 6


def test_nothing_changes_in_recordings_as_the_cmu_database_has_them():
    recording = Recording("one", WHOLE.times, WHOLE.values, CHANNELS, ("deg",) * 4 + ("",) * 2)
    assert in_pose_units(recording) is recording


def test_known_units_become_degrees_and_the_length_of_the_cmu_database():
    factors = pose_factors(("deg", "rad", "mm", "cm", "m", "", "sd"))
    inches = np.array([1 / 25.4, 1 / 2.54, 100 / 2.54])
    np.testing.assert_allclose(factors, [1, 180 / np.pi, *(0.45 * inches), 1, 1], rtol=1e-15)


def test_rates_follow_what_they_are_rates_of():
    degrees, radians = pose_factors(["deg", "deg/s"]), pose_factors(["rad", "rad/s"])
    np.testing.assert_allclose(radians / degrees, 180 / np.pi)
    np.testing.assert_allclose(*(pose_factors(["mm", f"mm/s{of}"]) for of in ("", "²")))
    assert pose_factors(["mm", "mm/s"])[0] == pose_factors(["mm", "mm/s"])[1]


def test_what_is_converted_once_is_not_again():
    once = in_pose_units(in_other_units(WHOLE))
    assert in_pose_units(once) is once
    np.testing.assert_allclose(once.values, in_pose_units(WHOLE).values, rtol=1e-14)


def test_predictions_come_back_in_the_units_of_the_channels():
    whole = in_other_units(WHOLE)
    ones = np.ones_like(whole.values)
    prediction, factors = from_pose_units(whole, ones, ones), pose_factors(whole.units)
    hidden, visible = ~whole.visible, whole.visible
    expected = np.broadcast_to(1 / factors, hidden.shape)
    np.testing.assert_allclose(prediction.mean[hidden], expected[hidden])
    np.testing.assert_allclose(prediction.variance[hidden], expected[hidden] ** 2)
    np.testing.assert_array_equal(prediction.mean[visible], whole.values[visible])
    assert from_pose_units(whole, ones).variance is None
