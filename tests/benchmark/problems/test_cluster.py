import numpy as np
import pytest

from mocapbench.baselines import Aligner, Clusterer
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.datasets import Recording, Skeleton
from mocapbench.metrics import purity

LENGTHS = (3, 5, 4)
NOBODY = Skeleton("nobody", 1.0, ())


class Fixed(Clusterer):
    """Answers whatever it was built with."""

    def __init__(self, labels=(0, 0, 1)):
        self.labels = labels

    def fit(self, recordings):
        self.n_recordings_ = len(recordings)
        self.labels_ = np.asarray(self.labels)
        return self


class FixedAligner(Fixed, Aligner):
    """Aligns as it was told, too."""

    def __init__(self, labels=(0, 0, 1), paths=((0, 1, 2), (1, 2, 3, 0, 1), (3, 0, 2, 3))):
        super().__init__(labels)
        self.paths = paths

    def fit(self, recordings):
        super().fit(recordings)
        self.cycle_length_, self.path_ = 4, tuple(map(np.asarray, self.paths))
        return self

    def align(self, recordings):
        return list(self.path_)


@pytest.fixture
def problem():
    train = tuple(
        Recording(f"take {n}", np.arange(float(n)), np.zeros((n, 2)), ("a", "b"), ("deg", "deg"))
        for n in LENGTHS
    )
    return ClusterProblem(train, None, ("walk", "walk", "run"), NOBODY)


def _solution(problem, model):
    return problem.solve(problem.fit(model), 0)


def test_clusters_are_set_beside_the_classes(problem):
    solution = _solution(problem, Fixed())
    assert set(solution) == {"labels"}
    assert purity(problem.outcome(solution)).value == 1.0
    wrong = problem.outcome(_solution(problem, Fixed((0, 1, 1))))
    assert purity(wrong).value == pytest.approx(2 / 3)


def test_a_model_that_aligns_leaves_its_paths(problem):
    solution = _solution(problem, FixedAligner())
    assert int(solution["cycle_length"]) == 4
    assert [solution[f"path-{k}"].tolist() for k in range(3)] == [
        [0, 1, 2],
        [1, 2, 3, 0, 1],
        [3, 0, 2, 3],
    ]


@pytest.mark.parametrize("labels", [(0, 0), (0.0, 0.5, 1.0), ("a", "a", "b"), ((0, 0, 1),)])
def test_labels_that_are_none_are_refused(problem, labels):
    with pytest.raises(InvalidPredictionError, match="expected 3 integers"):
        _solution(problem, Fixed(labels))


@pytest.mark.parametrize(
    ("paths", "complaint"),
    [
        (((0, 1, 2),), "a state for each frame"),
        (((0, 1), (0, 1, 2, 3, 0), (0, 1, 2, 3)), "a state for each frame"),
        (((0, 1, 4), (0, 1, 2, 3, 0), (0, 1, 2, 3)), "expected states 0 to 3"),
        (((0, 1, -1), (0, 1, 2, 3, 0), (0, 1, 2, 3)), "expected states 0 to 3"),
        (((0, 1, 0.5), (0, 1, 2, 3, 0), (0, 1, 2, 3)), "expected states 0 to 3"),
    ],
)
def test_paths_that_are_none_are_refused(problem, paths, complaint):
    with pytest.raises(InvalidPredictionError, match=complaint):
        _solution(problem, FixedAligner(paths=paths))
