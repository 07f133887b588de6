import numpy as np
import pytest

from mocapbench.baselines import Aligner, Clusterer
from mocapbench.benchmark import ClusterProblem, Clusters, InvalidPredictionError
from mocapbench.benchmark.problems.arrays import arrays_by_number, with_numbers
from mocapbench.datasets import Recording, Skeleton
from mocapbench.metrics import purity

LENGTHS = (3, 5, 4)
NOBODY = Skeleton("nobody", 1.0, ())


class Fixed(Clusterer):
    """Returns the labels that it was built with."""

    def __init__(self, labels=(0, 0, 1)):
        self.labels = labels

    def fit(self, recordings):
        self.n_recordings_ = len(recordings)
        self.labels_ = np.asarray(self.labels)
        return self


class FixedAligner(Fixed, Aligner):
    """Aligns along the paths that it was built with, too."""

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
    return ClusterProblem(train, ("walk", "walk", "run"), NOBODY)


def _solve(problem, model):
    return problem.solve(problem.fit(model), 0)


def test_clusters_are_set_beside_the_classes(problem):
    solution = _solve(problem, Fixed())
    assert set(problem.to_arrays(solution)) == {"labels"}
    assert solution.alignment is solution.blend is None
    assert purity(problem.outcome(solution)).value == 1.0
    wrong = problem.outcome(_solve(problem, Fixed((0, 1, 1))))
    assert purity(wrong).value == pytest.approx(2 / 3)


def test_a_model_that_aligns_leaves_its_paths(problem):
    solution = _solve(problem, FixedAligner())
    assert solution.alignment["cycle_length"] == 4
    assert [path.tolist() for path in arrays_by_number("path", solution.alignment)] == [
        [0, 1, 2],
        [1, 2, 3, 0, 1],
        [3, 0, 2, 3],
    ]


@pytest.mark.parametrize("labels", [(0, 0), (0.0, 0.5, 1.0), ("a", "a", "b"), ((0, 0, 1),)])
def test_labels_that_are_none_are_refused(problem, labels):
    with pytest.raises(InvalidPredictionError, match="expected 3 integers"):
        _solve(problem, Fixed(labels))


def test_paths_of_a_model_that_aligns_are_checked(problem):
    with pytest.raises(InvalidPredictionError, match="a state for each frame"):
        _solve(problem, FixedAligner(paths=((0, 1, 2),)))


LABELS = np.array([0, 0, 2])
PATHS = with_numbers("path", (np.arange(n) % 4 for n in range(1, 13)))
ALIGNMENT = {"cycle_length": np.array(4), **PATHS}
MOTIONS = np.random.default_rng(0).normal(size=(3, 75, 2))
BLEND = {"blend": MOTIONS, "blended": np.array([0, 2])}


@pytest.mark.parametrize("alignment", [None, ALIGNMENT])
@pytest.mark.parametrize("blend", [None, BLEND])
def test_an_answer_survives_the_store(survives, problem, alignment, blend):
    other = {"latent-path-0": np.zeros(3), "trend-mean": np.zeros(3)}
    solution = Clusters(LABELS, alignment, blend)
    assert survives(solution, problem.to_arrays, problem.from_arrays, other)
