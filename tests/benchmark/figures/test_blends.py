import numpy as np
import pytest

from mocapbench.benchmark import ClusterProblem, Clusters, Solved, draw_blends
from mocapbench.benchmark.problems.blending import N_FRAMES
from mocapbench.datasets import GaitLibrary, Recording, hlm_features

CHANNELS = ("lfemur.rx", "ltibia.rx")
LABELS = np.array([0, 0, 2])


@pytest.fixture
def problem():
    motion = GaitLibrary().motion("01_01")
    walk = hlm_features(motion.recording("walk"))
    train = tuple(
        Recording(f"take {k}", walk.times, walk.values, walk.channels, walk.units) for k in range(3)
    )
    return ClusterProblem(train, ("walk", "walk", "run"), motion.skeleton)


def test_it_is_drawn_as_stick_figures_and_as_curves_between_the_styles(problem):
    still = np.tile(problem.train[0].values[0], (N_FRAMES, 1))
    blend = {"blend": np.stack([still - 1.0, still, still + 1.0]), "blended": np.array([0, 2])}
    solved = Solved("style-clustering", problem, {"poses": Clusters(LABELS, blend=blend)})
    (illustration,) = draw_blends(solved, CHANNELS)
    strip, *curves = illustration.axes
    assert illustration.title == "Blend by poses"
    assert illustration.groups == ("transition", "cluster 0 (walk)", "cluster 2 (run)")
    assert strip.spatial
    assert [panel.title for panel in curves] == list(CHANNELS)
    for panel in curves:
        between, first, second = (curve.y for curve in panel.curves)
        np.testing.assert_allclose(first, between - 1.0)
        np.testing.assert_allclose(second, between + 1.0)
    heights = [np.nanmax(figure.y) - np.nanmin(figure.y) for figure in strip.curves]
    assert all(140.0 < height < 200.0 for height in heights)
    assert all(np.nanmin(figure.y) == pytest.approx(0.0) for figure in strip.curves)


def test_a_model_that_does_not_blend_has_no_picture(problem):
    solved = Solved("style-clustering", problem, {"groups only": Clusters(LABELS)})
    assert list(draw_blends(solved, CHANNELS)) == []
