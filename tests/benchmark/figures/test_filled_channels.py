import numpy as np
import pytest

from mocapbench.baselines import Prediction
from mocapbench.benchmark import ImputeProblem, Solved, draw_filled_channels
from mocapbench.datasets import Recording

CHANNELS = ("rhumerus.rx", "thorax.ry")
HIDDEN = np.arange(6) >= 4


@pytest.fixture
def problem():
    values = np.random.default_rng(0).normal(size=(6, 2))
    whole = Recording("walk", np.arange(6.0) / 30, values, CHANNELS, ("deg", "deg"))
    return ImputeProblem.of_one(whole, np.repeat(HIDDEN[:, None], 2, axis=1))


def _solved(problem, errors):
    """Return the problem, solved with a constant error at hidden entries, by label."""
    shown, truth = problem.given[0].visible, problem.truth[0]
    solutions = {
        label: (Prediction(np.where(shown, truth, truth + error)),)
        for label, error in errors.items()
    }
    return Solved("upper-body-missing", problem, solutions, papers={"nn": "NN", "absent": "HLM"})


def test_the_papers_models_and_the_best_other_are_shown_where_entries_are_hidden(problem):
    solved = _solved(problem, {"far": 9.0, "near": 1.0, "nn": 5.0})
    (illustration,) = draw_filled_channels(solved, CHANNELS)
    assert illustration.task == "upper-body-missing"
    assert illustration.groups == ("truth", "nn", "near")
    assert [panel.title for panel in illustration.axes] == list(CHANNELS)
    for column, panel in enumerate(illustration.axes):
        truth, nn, near = (curve.y for curve in panel.curves)
        np.testing.assert_array_equal(truth, problem.truth[0][:, column])
        np.testing.assert_array_equal(np.isnan(nn), ~HIDDEN)
        np.testing.assert_allclose(near[HIDDEN], truth[HIDDEN] + 1.0)


def test_the_channels_are_those_that_the_page_names(problem):
    (illustration,) = draw_filled_channels(_solved(problem, {"near": 1.0}), CHANNELS[1:])
    (panel,) = illustration.axes
    assert (panel.title, panel.y_label) == ("thorax.ry", "deg")
    np.testing.assert_array_equal(panel.curves[0].y, problem.truth[0][:, 1])
