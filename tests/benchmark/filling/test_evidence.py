"""The choice is good on real recordings; docs/evidence/fill.py has more of them."""

import os
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.filling.workers import Workers

PATH = Path(__file__).parents[3] / "docs" / "evidence" / "fill.py"
NAMES = ("02_01", "07_01", "35_01")


@pytest.fixture(scope="module")
def evidence():
    spec = spec_from_file_location("evidence_fill", PATH)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
@pytest.mark.recordings
def test_whole_frames_of_walks_are_filled_almost_as_well_as_by_the_best_model(evidence):
    if "MOCAPBENCH_DATA" not in os.environ:
        pytest.skip("MOCAPBENCH_DATA names no recordings")
    ratios = []
    with Workers(2) as workers:
        folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
        for _, kind, recording, hidden in evidence.problems(folder, NAMES):
            if kind == "frames":
                scores = evidence.evaluate(recording, hidden, workers, effort="low").scores()
                best = scores[evidence.find_best(scores)]
                ratios.append((scores["best"] / best, scores["best"] / scores["linear"]))
    to_best, to_linear = np.array(ratios).T
    assert len(ratios) == len(NAMES)
    assert to_best.mean() <= 1.10
    assert to_linear.max() <= 1.05
