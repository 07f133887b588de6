from functools import partial

import numpy as np
import pytest

from mocapbench.benchmark import Solved, draw_coregionalisation
from mocapbench.benchmark.tasks.pages.joints import JOINT_GROUPS

FIGURE = partial(draw_coregionalisation, label="mohgp-3", joint_groups=JOINT_GROUPS)


@pytest.fixture(scope="module")
def walking(posed):
    return posed("walking-interpolation", "synthetic observed 40")


@pytest.fixture(scope="module")
def matrices():
    factors = np.random.default_rng(0).normal(size=(3, 39, 2))
    return factors @ factors.transpose(0, 2, 1)


def test_components_of_a_layer_add_up_to_its_correlations(walking, matrices):
    internals = {"coregionalisation-parent": matrices, "coregionalisation-child": 4.0 * matrices}
    solved = Solved("walking", walking, {}, {"mohgp-3": internals})
    whole, leg, _ = FIGURE(solved)
    assert [*whole.maps][:4:3] == [
        "parent, component 1",
        "child, component 1",
    ]
    parent, child = (sum([*whole.maps.values()][k : k + 3]) for k in (0, 3))
    np.testing.assert_allclose(np.diag(parent), 1.0)
    np.testing.assert_allclose(parent, child)
    assert set(leg.labels) == {
        *("lfemur.rx", "lfemur.ry", "lfemur.rz", "ltibia.rx", "lfoot.rx", "lfoot.rz")
    }
    places = [walking.train[0].channels.index(channel) for channel in leg.labels]
    for part, of in zip(leg.maps.values(), whole.maps.values(), strict=True):
        np.testing.assert_array_equal(part, of[np.ix_(places, places)])
    assert whole.labels[places[0]] == "lfemur"


def test_matrices_are_shown_of_the_entrant_that_the_page_names(walking, matrices):
    internals = {"moa-1": {"coregionalisation-parent": matrices}}
    assert list(FIGURE(Solved("walking", walking, {}, internals))) == []
