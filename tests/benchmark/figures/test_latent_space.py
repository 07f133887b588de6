"""What models disclose of their latent spaces, and the figures made of it."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.model import GPDM
from mocapbench.baselines.gplvm import GPLVM
from mocapbench.benchmark.figures.gap_error import gap_sketch
from mocapbench.benchmark.figures.latent_space import latent_sketch
from mocapbench.benchmark.problems.internals import disclosed
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import open_archive
from mocapbench.reports import Space

TASK, CASE = TASKS.get("missing-frames"), "synthetic 1"


@pytest.fixture(scope="module")
def problem():
    return TASK.problem(TASK.case(CASE), Seeds(0, TASK.name, 1, CASE, 0), open_archive())


@pytest.fixture(scope="module")
def solutions(problem):
    models = {
        "gplvm-window": GPLVM(max_iter=1),
        "gpdm-map-viterbi": GPDM("map", max_iter=1, fill_iter=1),
        "gpdm-balanced-6d-viterbi": GPDM(n_latent=6, max_iter=1, fill_iter=1),
    }
    return {
        label: {**problem.solve(problem.fit(model), 0), **disclosed(model, problem.train)}
        for label, model in models.items()
    }


def test_latent_spaces_of_three_dimensions_are_shown(problem, solutions):
    gplvm, gpdm, walks = latent_sketch(problem, TASK, solutions)
    assert isinstance(gplvm, Space)
    assert [path.group for path in gplvm.paths] == ["training"] * 3
    assert {path.group for path in gpdm.paths} == {"training", "fair sample", "mean prediction"}
    assert "SNR(β)" in gplvm.caption
    assert "CLS(α)" in gpdm.caption
    assert [panel.title.partition(",")[0] for panel in walks.panels] == [
        "gpdm-map-viterbi: mean prediction",
        "gpdm-map-viterbi: fair sample",
    ]


def test_other_spaces_tell_their_parameters_only(solutions):
    told = {name for name in solutions["gpdm-balanced-6d-viterbi"] if not name.endswith("-0")}
    assert told == {f"property-{name}" for name in ("SNR(α)", "CLS(α)", "SNR(β)", "CLS(β)")}


def test_the_cloud_is_as_confident_as_the_model(problem, solutions):
    model = GPLVM(max_iter=1).fit(problem.train)
    cloud = solutions["gplvm-window"]["latent-cloud"].astype(float)
    np.testing.assert_allclose(model.confidence(cloud[:, :3]), cloud[:, 3], rtol=1e-4, atol=1e-4)


def test_the_error_along_the_gap_is_that_of_hidden_frames(problem, solutions):
    (illustration,) = gap_sketch(problem, TASK, solutions)
    hidden = np.flatnonzero(~problem.given[0].visible[:, 0])
    for curve in illustration.panels[0].curves:
        error = solutions[curve.group]["mean-0"] - problem.truth[0]
        np.testing.assert_array_equal(curve.x, hidden + 1)
        np.testing.assert_allclose(curve.y, np.linalg.norm(error[hidden], axis=1))
