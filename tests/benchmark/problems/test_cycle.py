import numpy as np
import pytest

from mocapbench.baselines import Aligner
from mocapbench.benchmark import InvalidPredictionError
from mocapbench.benchmark.problems.arrays import arrays_by_number
from mocapbench.benchmark.problems.cycle import alignment_of
from mocapbench.datasets import Recording

RECORDINGS = tuple(
    Recording(f"take {n}", np.arange(float(n)), np.zeros((n, 2)), ("a", "b"), ("deg", "deg"))
    for n in (3, 5, 4)
)


class Paths(Aligner):
    """Aligns four states along the paths that it was built with."""

    cycle_length_ = 4

    def __init__(self, paths=((0, 1, 2), (1, 2, 3, 0, 1), (3, 0, 2, 3))):
        self.paths = paths

    def fit(self, recordings):
        self.path_ = tuple(map(np.asarray, self.paths))
        return self

    def align(self, recordings):
        return list(self.path_)


def test_every_recording_has_its_path():
    alignment = alignment_of(Paths().fit(RECORDINGS), RECORDINGS)
    assert alignment["cycle_length"] == 4
    paths = arrays_by_number("path", alignment)
    assert tuple(tuple(path.tolist()) for path in paths) == Paths().paths


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
def test_paths_that_are_none_are_refused(paths, complaint):
    with pytest.raises(InvalidPredictionError, match=complaint):
        alignment_of(Paths(paths).fit(RECORDINGS), RECORDINGS)
