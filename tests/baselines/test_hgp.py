import numpy as np
import pytest

from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.hgp import HGP
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording, ToyProcess

TIMES = np.linspace(0.0, 5.0, 15)


def _recordings(seed, n_children=4):
    rng = np.random.default_rng(seed)
    process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    *others, last = process.draw(rng, TIMES, n_children)
    return (*others, last.hide(rng.random((15, 2)) < 0.7)), last.values


def test_a_channel_is_a_hierarchy_of_its_own():
    recordings, _ = _recordings(0)
    together = HGP(max_iter=30).fit(recordings)
    mean, variance = together.trend(TIMES)
    for d, channel in enumerate(recordings[0].channels):
        alone = [recording.select([channel]) for recording in recordings]
        model = MOHGP(rank=0, max_iter=30, n_restarts=1).fit(alone)
        for one, other in zip(together.impute(recordings), model.impute(alone), strict=True):
            np.testing.assert_array_equal(one.mean[:, [d]], other.mean)
            np.testing.assert_array_equal(one.variance[:, [d]], other.variance)
        trend = model.trend(TIMES)
        np.testing.assert_array_equal(mean[:, [d]], trend[0])
        np.testing.assert_array_equal(variance[:, [d]], trend[1])


def test_samples_have_the_moments_of_a_child_of_a_new_group():
    recordings, _ = _recordings(1)
    tree = {r.name: (group,) for r, group in zip(recordings, "aabb", strict=True)}
    model, n_samples = HGP(tree=tree, max_iter=20).fit(recordings), 20_000
    samples = model.sample(TIMES[:3], n_samples, 0)
    mean, _ = model.trend(TIMES[:3])
    variance = np.concatenate(
        [
            sum(one.coregionalisation_[layer].sum(axis=0)[0] for layer in ("group-1", "child"))
            + one.noise_
            for one in model.models_
        ]
    )
    # Five standard errors of a mean, and of a variance.
    assert (np.abs(samples.mean(axis=0) - mean) < 5 * np.sqrt(variance / n_samples)).all()
    assert (np.abs(samples.var(axis=0) / variance - 1.0) < 5 * np.sqrt(2 / n_samples)).all()


def test_samples_may_share_a_draw_of_the_trend():
    recordings, _ = _recordings(3)
    model = HGP(max_iter=5).fit(recordings)
    around_mean = model.sample(TIMES, 2000, 0).mean(axis=0)
    np.testing.assert_allclose(around_mean, model.trend(TIMES)[0], atol=0.1)
    model = HGP(max_iter=5, sampled_trend="posterior").fit(recordings)
    around_draw = model.sample(TIMES, 2000, 0).mean(axis=0)
    deviation = np.abs(around_draw - model.trend(TIMES)[0]) / np.sqrt(model.trend(TIMES)[1])
    assert 0.1 < deviation.mean() < 3.0


def test_a_common_trend_pays_where_there_is_one():
    errors = dict.fromkeys((HGP, GPIndependent), 0.0)
    for seed in range(4):
        recordings, truth = _recordings(seed)
        for model in errors:
            (prediction,) = model(kernel="rbf").fit(recordings).impute(recordings[-1:])
            errors[model] += np.mean((prediction.mean - truth) ** 2)
    assert errors[HGP] < errors[GPIndependent]


def test_every_channel_has_the_tree():
    recordings, _ = _recordings(2)
    tree = {recording.name: ("all",) for recording in recordings}
    model = HGP(tree=tree, max_iter=5).fit(recordings)
    assert [one.layers for one in model.models_] == [("parent", "group-1", "child")] * 2
    with pytest.raises(ValueError, match=r"none for \['child-4'\]"):
        HGP(tree={name: tree[name] for name in list(tree)[:3]}).fit(recordings)


def _grouped(rng):
    """Return children of three groups, the last child almost hidden; its values and the tree."""
    root = np.linalg.cholesky(
        np.exp(-0.5 * np.subtract.outer(TIMES, TIMES) ** 2) + np.eye(15) / 1e8
    )
    trend, *groups = root @ rng.standard_normal((4, 15, 1))
    recordings, tree = [], {}
    for i, group in enumerate(groups):
        for name in (f"{i}{r}" for r in range(3)):
            child = np.sqrt(0.1) * root @ rng.standard_normal((15, 1))
            noise = 0.05 * rng.standard_normal((15, 1))
            values = trend + group + child + noise
            recordings.append(Recording(name, TIMES, values, ("a",), ("",)))
            tree[name] = (f"group {i}",)
    last = recordings.pop()
    hidden = np.ones((15, 1), dtype=bool)
    hidden[[2, 7, 12]] = False
    return [*recordings, last.hide(hidden)], last.values, tree


def test_knowing_the_groups_pays_where_there_are_groups():
    errors = np.zeros(2)
    for seed in range(5):
        recordings, truth, tree = _grouped(np.random.default_rng(seed))
        for which, paths in enumerate((None, tree)):
            (prediction,) = HGP(tree=paths, kernel="rbf").fit(recordings).impute(recordings[-1:])
            errors[which] += np.sum((prediction.mean - truth) ** 2)
    assert errors[1] < errors[0]
