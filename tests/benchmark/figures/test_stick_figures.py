import numpy as np
import pytest

from mocapbench.benchmark import JointAngles
from mocapbench.benchmark.figures.stick_figures import N_FIGURES, STRIDE, strip
from mocapbench.datasets import GaitLibrary, hlm_features


def test_figures_are_set_apart_on_the_ground_at_even_times():
    motion = GaitLibrary().motion("01_01")
    walk = hlm_features(motion.recording("walk"))
    groups = [f"frame {frame}" for frame in range(len(walk.times))]
    panel = strip(walk, JointAngles(motion.skeleton), groups, "a walk, ")
    assert len(panel.curves) == N_FIGURES
    span = walk.times[-1] - walk.times[0]
    assert panel.title == f"a walk, every {span / (N_FIGURES - 1):.2g} s"
    assert panel.curves[0].group == groups[0]
    assert panel.curves[-1].group == groups[-1]
    for place, figure in enumerate(panel.curves):
        assert np.nanmin(figure.y) == pytest.approx(0.0)
        assert abs(np.nanmean(figure.x) - STRIDE * place) < STRIDE / 2
