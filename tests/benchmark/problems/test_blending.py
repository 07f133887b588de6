import numpy as np
import pytest

from mocapbench.baselines import Blender, Calibrated
from mocapbench.benchmark import ClusterProblem, InvalidPredictionError
from mocapbench.benchmark.problems.blending import N_FRAMES
from mocapbench.datasets import GaitLibrary, Recording, hlm_features

STYLES = ("walk", "walk", "run")


class Poses(Blender):
    """Mixes constant poses, one a style, and labels recordings as it was built to."""

    def __init__(self, n_styles=3, *, labels=(0, 0, 2), value=1.0):
        self.n_styles = n_styles
        self.labels = labels
        self.value = value

    def fit(self, recordings):
        self.labels_ = np.asarray(self.labels)
        self.n_channels_ = len(recordings[0].channels)
        return self

    def blend(self, weights):
        poses = weights @ np.arange(1.0, self.n_styles + 1)
        return self.value * poses[:, None] * np.ones(self.n_channels_)


@pytest.fixture
def problem():
    motion = GaitLibrary().motion("01_01")
    walk = hlm_features(motion.recording("walk"))
    train = tuple(
        Recording(f"take {k}", walk.times, walk.values, walk.channels, walk.units) for k in range(3)
    )
    return ClusterProblem(train, STYLES, motion.skeleton)


def _solve(problem, model):
    return problem.solve(problem.fit(model), 0)


def test_a_transition_leads_smoothly_from_one_style_to_the_other(problem):
    blend = _solve(problem, Poses()).blend
    first, between, second = blend["blend"]
    assert blend["blended"].tolist() == [0, 2]
    assert between.shape == (N_FRAMES, 62)
    np.testing.assert_allclose(between[0], first[0])
    np.testing.assert_allclose(between[-1], second[-1])
    assert (np.diff(between, axis=0) > 0).all()
    np.testing.assert_allclose(between[N_FRAMES // 2], (first + second)[0] / 2)


def test_the_styles_that_differ_most_are_taken(problem):
    for labels, styles in (((1, 0, 2), [0, 2]), ((1, 1, 2), [1, 2])):
        solution = _solve(problem, Poses(labels=labels))
        assert solution.blend["blended"].tolist() == styles


def test_styles_are_blended_by_a_model_in_its_calibration(problem):
    own, wrapped = (_solve(problem, model) for model in (Poses(), Calibrated(Poses())))
    np.testing.assert_array_equal(wrapped.blend["blend"], own.blend["blend"])


def test_one_cluster_leaves_nothing_to_blend(problem):
    solution = _solve(problem, Poses(labels=(1, 1, 1)))
    assert solution.blend is None
    assert set(problem.to_arrays(solution)) == {"labels"}


@pytest.mark.parametrize("value", [np.nan, np.inf, np.ones((2, 1, 1))])
def test_a_motion_that_is_none_is_refused(problem, value):
    with pytest.raises(InvalidPredictionError, match="blend: expected finite frames of shape"):
        _solve(problem, Poses(value=value))
