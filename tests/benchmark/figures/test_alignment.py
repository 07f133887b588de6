import numpy as np
import pytest

from mocapbench.benchmark import ClusterProblem, Clusters, Solved, draw_alignments
from mocapbench.benchmark.problems.arrays import with_numbers
from mocapbench.datasets import Recording, Skeleton

TIMES = np.arange(6.0) / 30
LABELS = np.array([0, 0, 1])


def _recording(seed):
    values = np.random.default_rng(seed).normal(size=(6, 2))
    return Recording(f"take {seed}", 2.0 + TIMES, values, ("a", "b"), ("deg", "deg"))


@pytest.fixture
def problem():
    train = tuple(map(_recording, range(3)))
    return ClusterProblem(train, ("walk", "walk", "run"), Skeleton("nobody", 1.0, ()))


def test_each_model_that_aligns_has_a_panel_beside_the_recordings(problem):
    path = np.array([2, 3, 0, 2, 3, 1])
    solutions = {
        "groups only": Clusters(LABELS),
        "aligner": Clusters(
            LABELS, {"cycle_length": np.array(4), **with_numbers("path", [path] * 3)}
        ),
    }
    (illustration,) = draw_alignments(Solved("style-clustering", problem, solutions))
    before, after = illustration.axes
    assert illustration.groups == ("walk", "run")
    assert after.title == "aligned by aligner"
    for one, other in zip(before.curves, after.curves, strict=True):
        np.testing.assert_allclose(one.x, TIMES)
        np.testing.assert_allclose(other.x, np.array([2, 3, 4, 6, 7, 9]) / 4)
        np.testing.assert_array_equal(one.y, other.y)


def test_the_curve_is_the_second_principal_component(problem):
    frames = np.concatenate([recording.values for recording in problem.train])
    centred = frames - frames.mean(axis=0)
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    (illustration,) = draw_alignments(Solved("style-clustering", problem, {}))
    drawn = np.concatenate([curve.y for curve in illustration.axes[0].curves])
    np.testing.assert_allclose(np.abs(drawn), np.abs(centred @ axes[1]))
