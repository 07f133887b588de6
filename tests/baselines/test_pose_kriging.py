from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from samples import gap

from mocapbench.baselines import pose_kriging as module
from mocapbench.baselines.kriging.conditioned import copy_gaps
from mocapbench.baselines.kriging.own_course import own_course
from mocapbench.baselines.kriging.paths import (
    blend_paths,
    doubt_about_path,
    match_paths,
    weigh_paths,
)
from mocapbench.baselines.pose_kriging import PoseKriging, _unite
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.datasets import Recording

STEP = 2 * np.pi / 20.3


def walk(name, start, n_frames, style=0.0):
    """Return a cycle of three channels, from which a style deviates as a function of the phase."""
    angle = STEP * (start + np.arange(n_frames))
    values = np.column_stack([np.sin(angle), np.cos(angle), np.sin(angle + 1.0)])
    values = values + style * np.column_stack([np.cos(2 * angle), np.sin(angle), 1 + 0 * angle])
    return Recording(name, np.arange(n_frames) / 30, values, ("a", "b", "c"), ("",) * 3)


TRAINING = [walk("one", 0, 50), walk("two", 3, 45)]


def error(model, truth, first, last):
    (filled,) = model.fit(TRAINING).impute([gap(truth, first, last)])
    return np.sqrt(np.mean((filled.mean - truth.values)[first:last] ** 2))


@pytest.mark.parametrize(("first", "last"), [(8, 20), (0, 10), (30, 40)])
def test_training_motion_is_found_wherever_the_gap_is(first, last):
    assert error(PoseKriging(), walk("new", 5, 40), first, last) < 0.03


def test_a_style_that_repeats_with_the_pose_is_carried_into_the_gap():
    truth = walk("new", 2, 44, style=0.2)
    with_poses = error(PoseKriging(), truth, 26, 38)
    assert with_poses < 0.7 * error(PoseViterbi(), truth, 26, 38)
    assert with_poses < 0.7 * error(PoseKriging(pose_variance=0.0), truth, 26, 38)


def test_a_recording_among_its_training_is_filled_as_if_it_were_not():
    incomplete = gap(walk("new", 2, 44, style=0.2), 26, 38)
    (without,) = PoseKriging().fit(TRAINING).impute([incomplete])
    (among,) = PoseKriging().fit([incomplete, *TRAINING]).impute([incomplete])
    # What it learns of the scale of all channels includes the recording's own frames.
    np.testing.assert_allclose(among.mean, without.mean, atol=5e-3)
    np.testing.assert_allclose(among.variance, without.variance, rtol=0.1)


def test_the_only_recording_is_not_matched_with_itself():
    """It would seem free of error at visible frames, and its intervals would be far too narrow."""
    truth = walk("alone", 0, 60, style=0.3)
    given = gap(truth, 25, 40)
    model = PoseKriging().fit([given])
    (prediction,) = model.impute([given])
    visible = given.visible.all(axis=1)
    mean, variance = own_course(given.values, visible, 1e-12 * model.total_variance_)
    np.testing.assert_allclose(prediction.mean[~visible], mean[~visible])
    np.testing.assert_allclose(prediction.variance[~visible], variance[~visible])
    errors = np.abs(prediction.mean - truth.values)[25:40] / np.sqrt(prediction.variance[25:40])
    assert errors.max() < 5.0


def test_of_one_visible_frame_nothing_is_sure():
    truth = walk("alone", 0, 40)
    hidden = np.ones((40, 3), dtype=bool)
    with pytest.raises(ValueError, match="recording 'alone': expected a visible frame, got none"):
        PoseKriging().fit([truth]).impute([truth.hide(hidden)])
    hidden[20] = False
    (prediction,) = PoseKriging().fit([truth]).impute([truth.hide(hidden)])
    errors = np.abs(prediction.mean - truth.values) / np.sqrt(np.maximum(prediction.variance, 1e-9))
    assert errors.max() < 3.0


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(-1000.0, 1000.0), min_size=3, max_size=3), st.integers(0, 28))
def test_a_constant_added_to_a_recording_is_added_to_its_fill(offsets, first):
    model = PoseKriging().fit(TRAINING)
    truth = walk("new", 5, 40, style=0.1)
    (here,) = model.impute([gap(truth, first, first + 12)])
    (there,) = model.impute([gap(truth.with_values(truth.values + offsets), first, first + 12)])
    hidden = slice(first, first + 12)
    np.testing.assert_allclose(there.mean - offsets, here.mean, atol=1e-7)
    np.testing.assert_allclose(there.variance[hidden], here.variance[hidden], rtol=1e-6)


def limping(name, start, n_frames, style):
    """Return a walk on two legs, which take turns; ``style`` is what both do alike."""
    phases = STEP * (start + np.arange(n_frames)), STEP * (start + 10.15 + np.arange(n_frames))
    legs = [[np.sin(p) + style * np.exp(2 * np.cos(p - 1)), np.cos(p)] for p in phases]
    values = np.column_stack(legs[0] + legs[1])
    channels = ("lfemur.rx", "ltibia.rx", "rfemur.rx", "rtibia.rx")
    return Recording(name, np.arange(n_frames) / 30, values, channels, ("deg",) * 4)


def facing(name, start, n_frames, style=0.0):
    """Return a walk with angles in the middle of the body, whose signs the mirror changes."""
    angle = STEP * (start + np.arange(n_frames))
    middle = np.column_stack([0.3 * np.sin(angle), 0.2 * np.sin(angle + 1.0)])
    legs = limping(name, start, n_frames, style)
    channels = ("root.ry", "root.rz", *legs.channels)
    return Recording(name, legs.times, np.hstack([middle, legs.values]), channels, ("deg",) * 6)


FACING = [facing("one", 0, 50), facing("two", 3, 45)]


@pytest.mark.parametrize("turns", [{"root.rz": 360.0}, {"root.ry": 180.0, "root.rz": 77.0}])
@pytest.mark.parametrize("among", ["test", "training"])
def test_where_a_body_faces_changes_nothing_though_the_mirror_flips_its_sign(turns, among):
    truth = facing("new", 0, 30, 0.15)
    moved = np.array([turns.get(channel, 0.0) for channel in truth.channels])
    by = [moved, 0.0] if among == "training" else [0.0, 0.0]
    training = [one.with_values(one.values + each) for one, each in zip(FACING, by, strict=True)]
    model, turned = PoseKriging().fit(FACING), PoseKriging().fit(training)
    assert len(model.symmetries_) == len(turned.symmetries_) == 2
    moved = moved if among == "test" else np.zeros(6)
    (here,) = model.impute([gap(truth, 13, 23)])
    (there,) = turned.impute([gap(truth.with_values(truth.values + moved), 13, 23)])
    np.testing.assert_allclose(there.mean - moved, here.mean, atol=1e-7)
    np.testing.assert_allclose(there.variance, here.variance, rtol=1e-6)


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6), st.booleans())
def test_whole_turns_of_any_angle_change_nothing(turns, in_training):
    moved = 360.0 * np.array(turns)
    truth = facing("new", 0, 30, 0.15)
    (here,) = PoseKriging().fit(FACING).impute([gap(truth, 13, 23)])
    training = [FACING[0].with_values(FACING[0].values + moved * in_training), FACING[1]]
    given = gap(truth.with_values(truth.values + moved), 13, 23)
    (there,) = PoseKriging().fit(training).impute([given])
    np.testing.assert_allclose(there.mean - moved, here.mean, atol=1e-7)


def test_of_one_frame_the_fill_is_as_unsure_as_training_moves():
    hidden = np.ones((40, 6), dtype=bool)
    hidden[20] = False
    truth = facing("new", 0, 40, 0.15)
    model = PoseKriging().fit(FACING)
    (prediction,) = model.impute([truth.hide(hidden)])
    assert (prediction.variance[hidden] >= model.total_variance_ * 0.05).all()


def conditional_variance(model, recording, matched):
    """Return the conditional variance of the residuals, the doubt about the path left out."""
    visible = recording.visible[:, 0]
    ((_, process),) = model._residuals().condition(matched, visible)
    scales = process.scales((recording.values - matched)[visible], 0.0)
    return np.outer(process.variance, scales)


@settings(max_examples=15, deadline=None)
@given(st.floats(0.0, 0.3), st.integers(0, 19), st.integers(4, 20))
def test_the_doubt_about_the_path_only_adds_to_the_variance(style, start, first):
    model = PoseKriging(least_explained=0.0).fit(TRAINING)
    recording = gap(walk("new", start, 40, style=style), first, first + 12)
    paths, errors = match_paths(recording, model.matchers_)
    matched = np.tensordot(weigh_paths(errors), paths, axes=1)
    (prediction,) = model.impute([recording])
    hidden = ~recording.visible
    conditional = conditional_variance(model, recording, matched)[hidden]
    assert (prediction.variance[hidden] >= conditional * (1 - 1e-9)).all()


def test_the_mean_is_a_blend_of_what_each_path_predicts():
    model = PoseKriging().fit(TRAINING)
    recording = gap(walk("new", 2, 30, style=0.2), 10, 16)
    paths, errors = match_paths(recording, model.matchers_)
    weights, visible = weigh_paths(errors), recording.visible[:, 0]
    matched = np.tensordot(weights, paths, axes=1)
    ((_, process),) = model._residuals().condition(matched, visible)
    each = [path + process.mean((recording.values - path)[visible]) for path in paths]
    mean, _ = model._correct_paths(recording, paths, weights)
    residuals = (recording.values - paths)[:, visible]
    scales = process.scales(np.average(residuals, axis=0, weights=weights), 0.0)
    blended = blend_paths(weights, process.products(residuals, scales))
    np.testing.assert_allclose(mean, np.average(each, axis=0, weights=blended), atol=1e-9)


def test_residuals_vary_as_much_more_as_copies_of_the_gaps_err_more_than_expected(monkeypatch):
    model, recording = PoseKriging().fit(TRAINING), gap(walk("new", 2, 30, style=0.2), 10, 13)
    paths, errors = match_paths(recording, model.matchers_)
    weights, visible = weigh_paths(errors), recording.visible[:, 0]
    matched = np.tensordot(weights, paths, axes=1)
    ((_, process),) = model._residuals().condition(matched, visible)
    residuals = (recording.values - matched)[visible]
    scales = process.scales(residuals, 1e-12 * model.total_variance_)
    given = []
    monkeypatch.setattr(module, "growth_of_variance", lambda sums: given.append(sums) or 3.0)
    _, variance = model._correct_paths(recording, paths, weights)
    expected = process.leave_out(copy_gaps(visible), residuals, scales)
    np.testing.assert_allclose(given[0], expected)
    corrected = [path + process.mean((recording.values - path)[visible]) for path in paths]
    grown = 3.0 * process.variances(scales) + doubt_about_path(np.array(corrected), weights)
    np.testing.assert_allclose(variance, grown)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.01, 100.0), st.floats(0.01, 100.0))
def test_the_surer_of_two_predictions_counts_so_that_the_mean_errs_least(one, other):
    """Errors correlate by one half."""
    means, shape = (np.zeros((2, 3)), np.ones((2, 3))), (2, 3)
    mean, variance = _unite((means[0], np.full(shape, one)), (means[1], np.full(shape, other)))
    share = np.linspace(0.0, 1.0, 1001)
    error = (1.0 - share) ** 2 * one + share**2 * other
    error += share * (1.0 - share) * np.sqrt(one * other)
    best = share[error.argmin()]
    np.testing.assert_allclose(mean, best, atol=1e-3)
    spread = best * (1.0 - best)
    np.testing.assert_allclose(variance, (1.0 - best) * one + best * other + spread, rtol=0.02)


def test_a_fill_unites_the_paths_with_the_own_course():
    model, given = PoseKriging().fit(TRAINING), gap(walk("new", 2, 44, style=0.6), 26, 29)
    paths, errors = match_paths(given, model.matchers_)
    along_paths = model._correct_paths(given, paths, weigh_paths(errors))
    visible = given.visible.all(axis=1)
    own = own_course(given.values, visible, 1e-12 * model.total_variance_)
    assert np.abs(along_paths[0] - own[0])[26:29].max() > 1e-3
    (filled,) = model.impute([given])
    mean, variance = _unite(along_paths, own)
    np.testing.assert_allclose(filled.mean[26:29], mean[26:29])
    np.testing.assert_allclose(filled.variance[26:29], variance[26:29])


def test_what_one_leg_does_before_the_gap_tells_what_the_other_does_in_it():
    training = [limping("one", 0, 50, 0.0), limping("two", 3, 45, 0.0)]
    truth = limping("new", 0, 30, 0.15)
    hidden = slice(10, 22)
    errors = []
    for symmetry in (0.0, 0.8):
        model = PoseKriging(symmetry=symmetry).fit(training)
        assert len(model.symmetries_) == 2
        (filled,) = model.impute([gap(truth, hidden.start, hidden.stop)])
        errors.append(np.sqrt(np.mean((filled.mean - truth.values)[hidden] ** 2)))
    assert errors[1] < 0.8 * errors[0]


def test_images_do_not_correlate_without_symmetry():
    model = PoseKriging(symmetry=0.0).fit([limping("one", 0, 50, 0.0)])
    covariance = model._residuals().covariance(limping("new", 0, 20, 0.1).values)
    np.testing.assert_array_equal(covariance[:20, 20:], 0.0)
    together = PoseKriging().fit([limping("one", 0, 50, 0.0)])
    covariance = together._residuals().covariance(limping("new", 0, 20, 0.1).values)
    assert np.linalg.eigvalsh(covariance).min() > -1e-9


def standing(n_frames=40):
    values = np.random.default_rng(0).normal(scale=0.01, size=(n_frames, 3)).cumsum(axis=0)
    return Recording("still", np.arange(n_frames) / 30, values, ("a", "b", "c"), ("",) * 3)


def test_a_motion_unlike_its_training_is_filled_from_its_own_course():
    model = PoseKriging().fit(TRAINING)
    recording = gap(standing(), 10, 30)
    (prediction,) = model.impute([recording])
    hidden = ~recording.visible[:, 0]
    mean, variance = own_course(recording.values, ~hidden, 1e-12 * model.total_variance_)
    np.testing.assert_array_equal(prediction.mean[hidden], mean[hidden])
    np.testing.assert_array_equal(prediction.variance[hidden], variance[hidden])
    assert np.abs(prediction.mean - standing().values).max() < 0.2


def test_what_is_filled_from_its_own_course_owes_nothing_to_training():
    recording = gap(standing(), 10, 30)
    (here,) = PoseKriging().fit(TRAINING).impute([recording])
    (there,) = PoseKriging().fit([walk("other", 7, 60, style=0.3)]).impute([recording])
    np.testing.assert_allclose(here.mean, there.mean)
    np.testing.assert_allclose(here.variance, there.variance)


def test_neither_the_order_of_training_nor_company_matters():
    recordings = [gap(walk("new", 5, 40), 8, 20), gap(standing(), 10, 30)]
    one = PoseKriging().fit(TRAINING).impute(recordings)
    other = PoseKriging().fit(TRAINING[::-1]).impute(recordings[::-1])[::-1]
    for here, there in zip(one, other, strict=True):
        np.testing.assert_allclose(here.mean, there.mean, atol=1e-9)
        np.testing.assert_allclose(here.variance, there.variance, rtol=1e-6)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"pose_lengthscale": 0.0}, "pose_lengthscale to be a finite positive"),
        ({"time_lengthscale": -1.0}, "time_lengthscale to be a finite positive"),
        ({"pose_variance": -1.0}, "pose_variance to be a finite number of at least 0"),
        ({"symmetry": 1.5}, "symmetry to be a number from 0 to 1"),
        ({"least_explained": 2.0}, "least_explained to be a number from 0 to 1"),
        ({"smoothness": "1"}, "smoothness to be a finite positive"),
    ],
)
def test_parameters_are_validated(parameters, message):
    with pytest.raises(ValueError, match=message):
        PoseKriging(**parameters).fit(TRAINING)


def test_what_cannot_be_filled_is_refused():
    with pytest.raises(ValueError, match="two consecutive frames"):
        PoseKriging().fit([walk("one", 0, 1)])
    model = PoseKriging().fit(TRAINING)
    with pytest.raises(ValueError, match="'new': expected a visible frame"):
        model.impute([gap(walk("new", 0, 5), 0, 5)])
    with pytest.raises(ValueError, match="expected channels"):
        model.impute([walk("new", 0, 5).select(["a"])])


def test_where_training_recordings_part_the_intervals_hold_them_all():
    """All do the same where the new one is visible, so that their paths alone differ."""
    base, bump = walk("one", 0, 60), np.zeros((60, 3))
    bump[28:38, 1] = 0.5 * np.hanning(10)
    away = {"none": 0.0, "forth": 1.0, "back": -1.0}
    training = [
        replace(base, name=name, values=base.values + share * bump) for name, share in away.items()
    ]
    truth = walk("new", 0, 60, style=0.1)
    (prediction,) = PoseKriging().fit(training).impute([gap(truth, 26, 40)])
    middle = slice(31, 35)
    spread = np.sqrt(prediction.variance[middle, 1])
    for share in away.values():
        off = (prediction.mean - truth.values - share * bump)[middle, 1]
        assert (np.abs(off) < 2.0 * spread).all()
