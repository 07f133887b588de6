from functools import partial

import numpy as np
import pytest

from mocapbench.baselines import GPDM, GPLVM
from mocapbench.benchmark import Solved, draw_latent_spaces
from mocapbench.benchmark.problems.internals import internals_of
from mocapbench.reports import Space

FIGURE = partial(
    draw_latent_spaces, labels=("gplvm-window", "gpdm-map-viterbi", "gpdm-6d", "absent")
)


@pytest.fixture(scope="module")
def problem(posed):
    return posed("missing-frames", "synthetic 1")


@pytest.fixture(scope="module")
def solved(problem):
    models = {
        "gpdm-map-viterbi": GPDM("map", max_iter=1, fill_iter=1),
        "gplvm-window": GPLVM(max_iter=1),
        "gpdm-6d": GPDM(n_latent=6, max_iter=1, fill_iter=1),
    }
    internals = {
        label: internals_of(model.fit(problem.train), problem.train)
        for label, model in models.items()
    }
    return Solved("missing-frames", problem, {}, internals)


def test_latent_spaces_of_three_dimensions_are_shown(solved):
    gplvm, gpdm, walks = FIGURE(solved)
    assert isinstance(gplvm, Space)
    assert gplvm.title == "Latent space of gplvm-window"
    assert [name for name, _ in gplvm.paths] == ["training"] * 3
    assert {name for name, _ in gpdm.paths} == {"training", "fair sample", "mean prediction"}
    assert "SNR(β)" in gplvm.caption
    assert "CLS(α)" in gpdm.caption
    assert [panel.title.partition(",")[0] for panel in walks.axes] == [
        "gpdm-map-viterbi: mean prediction",
        "gpdm-map-viterbi: fair sample",
    ]


def test_the_cloud_has_the_confidence_for_its_values(solved):
    gplvm, *_ = FIGURE(solved)
    stored = solved.internals["gplvm-window"]["latent-cloud"]
    np.testing.assert_array_equal(gplvm.cloud, stored[:, :3])
    np.testing.assert_array_equal(gplvm.values, stored[:, 3])


@pytest.mark.parametrize("label", ["gpdm-6d", "trivial"])
def test_an_entrant_without_such_a_space_is_left_out(problem, solved, label):
    internals = {"trivial": {}, **solved.internals}
    alone = Solved("missing-frames", problem, {}, {label: internals[label]})
    assert list(draw_latent_spaces(alone, (label,))) == []
