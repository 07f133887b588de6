import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.baselines import Aligner
from mocapbench.benchmark import InvalidPredictionError
from mocapbench.benchmark.problems.cycle import Alignment, alignment_of
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
    assert alignment.cycle_length == 4
    assert tuple(tuple(path.tolist()) for path in alignment.paths) == Paths().paths


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


@settings(max_examples=25)
@given(st.integers(1, 200), st.lists(arrays(np.intp, st.integers(1, 9)), max_size=12))
def test_an_alignment_survives_the_store(survives, cycle_length, paths):
    assert survives(Alignment(cycle_length, tuple(paths)), {"latent-path-0": np.zeros(3)})
