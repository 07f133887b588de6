"""`MOHGP` with recordings in groups."""

import numpy as np
import pytest
from sklearn.base import clone

from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording

TREE = {"a": ("walk", "one"), "b": ("walk", "one"), "c": ("walk", "two"), "d": ("run", "two")}
OFF = np.array([0.1, 3.3])


def _recordings():
    """Two curves a recording, with times and hidden entries of its own."""
    recordings = []
    for seed, name in enumerate(TREE):
        rng = np.random.default_rng(seed)
        times = np.sort(rng.uniform(0.0, 4.0, 9))
        shift = 0.3 * seed if name != "d" else 2.0
        curves = np.column_stack([np.sin(times + shift), np.cos(2.0 * times) + shift])
        curves += 0.05 * rng.standard_normal(curves.shape)
        recording = Recording(name, times, curves, ("hip", "knee"), ("deg", "deg"))
        recordings.append(recording.hide(rng.random((9, 2)) < 0.3))
    return recordings


@pytest.fixture(scope="module")
def recordings():
    return _recordings()


@pytest.fixture(scope="module")
def fitted(recordings):
    return MOHGP(tree=TREE, max_iter=15).fit(recordings)


def joint(fitted, recordings, target=None, times=OFF):
    """Return data, their covariance, the target's with them, and its variance (M D,).

    A target is a node, whose curve is the sum of the draws from the root down to it.
    """
    points = [
        ((*TREE[r.name], r.name), t, d, value)
        for r in recordings
        for t, row in zip(r.times, r.values, strict=True)
        for d, value in enumerate(row)
        if not np.isnan(value)
    ]
    wanted = [(target, t, d) for t in times for d in range(2)] if target is not None else []

    def covariance(left, right, level):
        return np.array([[_covariance(fitted, a, b, level) for b in right] for a in left])

    values = np.array([value - fitted.scaling_.mean[d] for _, _, d, value in points])
    noise = np.array([fitted.noise_[d] for _, _, d, _ in points])
    depth = len(target or ())
    return (
        values,
        covariance(points, points, 3) + np.diag(noise),
        covariance(wanted, points, depth),
        np.diag(covariance(wanted, wanted, depth)) if wanted else None,
    )


def _covariance(fitted, one, two, level):
    """Return the covariance of two entries, by the draws that they share down to a level."""
    (a, t, d), (b, s, e) = one[:3], two[:3]
    return sum(
        fitted.covariance(name, np.array([t, s])).reshape(2, 2, 2, 2)[d, 0, e, 1]
        for depth, name in enumerate(fitted.layers)
        if depth <= level and a[:depth] == b[:depth]
    )


def test_the_likelihood_is_that_of_the_joint_gaussian(fitted, recordings):
    data, covariance, _, _ = joint(fitted, recordings)
    _, log_determinant = np.linalg.slogdet(2.0 * np.pi * covariance)
    expected = -0.5 * (log_determinant + data @ np.linalg.solve(covariance, data))
    assert fitted.log_likelihood_ == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("group", [(), ("walk",), ("walk", "two"), ("run", "two")])
def test_trends_of_groups_condition_the_joint_gaussian(group, fitted, recordings):
    data, covariance, cross, prior = joint(fitted, recordings, group)
    gain = np.linalg.solve(covariance, cross.T).T
    mean, variance = fitted.trend(OFF, group=group)
    expected = (gain @ data).reshape(2, 2) + fitted.scaling_.mean
    np.testing.assert_allclose(mean, expected, rtol=1e-8)
    expected = (prior - np.einsum("ij,ij->i", gain, cross)).reshape(2, 2)
    np.testing.assert_allclose(variance, expected, rtol=1e-6)


@pytest.mark.slow
def test_imputations_condition_the_joint_gaussian(fitted, recordings):
    for recording, prediction in zip(recordings, fitted.impute(recordings), strict=True):
        leaf = (*TREE[recording.name], recording.name)
        data, covariance, cross, prior = joint(fitted, recordings, leaf, recording.times)
        gain = np.linalg.solve(covariance, cross.T).T
        hidden = ~recording.visible
        mean = (gain @ data).reshape(-1, 2) + fitted.scaling_.mean
        variance = (prior - np.einsum("ij,ij->i", gain, cross)).reshape(-1, 2) + fitted.noise_
        np.testing.assert_allclose(prediction.mean[hidden], mean[hidden], rtol=1e-8)
        np.testing.assert_allclose(prediction.variance[hidden], variance[hidden], rtol=1e-6)


def test_layers_have_numbers_of_components_of_their_own(recordings):
    sizes = {"parent": 2, "group-1": 1, "group-2": 1, "child": 3}
    model = MOHGP(tree=TREE, n_components=sizes, max_iter=2).fit(recordings)
    assert {name: len(b) for name, b in model.coregionalisation_.items()} == sizes
    with pytest.raises(ValueError, match="group-1"):
        MOHGP(tree=TREE, n_components={"parent": 2, "child": 3}).fit(recordings)


def test_a_tree_without_groups_is_none(recordings):
    flat = MOHGP(tree=dict.fromkeys(TREE, ()), max_iter=5).fit(recordings)
    assert flat.log_likelihood_ == MOHGP(max_iter=5).fit(recordings).log_likelihood_


def test_more_groups_explain_more(recordings):
    """Two layers are a special case of four."""
    two, four = (MOHGP(tree=tree).fit(recordings) for tree in (None, TREE))
    assert four.log_likelihood_ > two.log_likelihood_


def test_the_order_of_recordings_means_nothing(recordings):
    one, two = (MOHGP(tree=TREE, max_iter=3).fit(order) for order in (recordings, recordings[::-1]))
    assert one.log_likelihood_ == pytest.approx(two.log_likelihood_, rel=1e-9)


@pytest.mark.parametrize("group", [("jump",), "run", [["run"]], 5, None])
def test_a_group_is_one_of_the_tree(group, fitted):
    with pytest.raises(ValueError, match=r"one of \[\(\), \('run',\).* got ") as raised:
        fitted.trend(OFF, group=group)
    assert repr(group) in str(raised.value)


def test_wrong_trees_and_recordings_are_refused(fitted, recordings):
    with pytest.raises(ValueError, match="equally long"):
        MOHGP(tree=TREE | {"a": ("walk",)}).fit(recordings)
    with pytest.raises(ValueError, match=r"got one for \['e'\]"):
        MOHGP(tree=TREE | {"e": ("walk", "one")}).fit(recordings)
    with pytest.raises(ValueError, match="give it to fit"):
        fitted.impute([Recording("e", OFF, np.zeros((2, 2)), ("hip", "knee"), ("deg", "deg"))])
    assert clone(fitted).get_params()["tree"] == TREE
