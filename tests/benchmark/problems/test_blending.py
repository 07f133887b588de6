import numpy as np
import pytest

from mocapbench.baselines import Blender
from mocapbench.benchmark.figures.sketches import sketch
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.benchmark.problems.blending import N_FRAMES
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.registry import TASKS
from mocapbench.datasets import GaitLibrary, Recording, hlm_features

TASK = TASKS.get("style-clustering")
STYLES = ("walk", "walk", "run")


class Poses(Blender):
    """Mixes constant poses, one a style, and calls the clusters what it was told."""

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
    return ClusterProblem(train, None, STYLES, motion.skeleton)


def _solution(problem, model):
    return problem.solve(problem.fit(model), 0)


def test_a_passage_leads_smoothly_from_one_style_to_the_other(problem):
    solution = _solution(problem, Poses())
    first, between, second = solution["blend"]
    assert solution["blended"].tolist() == [0, 2]
    assert between.shape == (N_FRAMES, 62)
    np.testing.assert_allclose(between[0], first[0])
    np.testing.assert_allclose(between[-1], second[-1])
    assert (np.diff(between, axis=0) > 0).all()
    np.testing.assert_allclose(between[N_FRAMES // 2], (first + second)[0] / 2)


def test_the_styles_that_differ_most_are_taken(problem):
    assert _solution(problem, Poses(labels=(1, 0, 2)))["blended"].tolist() == [0, 2]
    assert _solution(problem, Poses(labels=(1, 1, 2)))["blended"].tolist() == [1, 2]


def test_one_cluster_has_nothing_to_pass_to(problem):
    assert set(_solution(problem, Poses(labels=(1, 1, 1)))) == {"labels"}


@pytest.mark.parametrize("value", [np.nan, np.inf, np.ones((2, 1, 1))])
def test_a_motion_that_is_none_is_refused(problem, value):
    with pytest.raises(InvalidPredictionError, match="blend: expected finite frames of shape"):
        _solution(problem, Poses(value=value))


def test_it_is_drawn_as_stick_figures_and_as_curves_between_the_styles(problem):
    walk = problem.train[0].values[0]
    solution = {**_solution(problem, Poses())}
    solution["blend"] = np.tile(walk, (3, N_FRAMES, 1))
    _, illustration = sketch(problem, TASK, {"poses": solution})
    strip, *curves = illustration.panels
    assert illustration.groups == ("passage", "cluster 0 (walk)", "cluster 2 (run)")
    assert strip.spatial
    assert [panel.title for panel in curves] == list(TASK.illustrated_channels)
    heights = [np.nanmax(figure.y) - np.nanmin(figure.y) for figure in strip.curves]
    assert all(140.0 < height < 200.0 for height in heights)
    assert all(np.nanmin(figure.y) == pytest.approx(0.0) for figure in strip.curves)
