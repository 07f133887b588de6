import numpy as np
import pytest

from mocapbench.baselines.gp.planner import PLANS


def _plan(example, name="auto"):
    return PLANS[name](example.kernel, example.reduction, example.parameters).name


def test_many_outputs_are_split_and_few_are_not(case):
    rng = np.random.default_rng(0)
    assert _plan(case(rng, n_outputs=3, n_times=50, masks="complete")) == "dense"
    assert _plan(case(rng, n_outputs=39, n_times=90, masks="complete")) == "latent-split"


def test_many_patterns_are_not_split(case):
    example = case(np.random.default_rng(0), n_outputs=6, n_replicates=12, n_times=40)
    assert _plan(example) == "dense"


def test_many_frames_are_passed_through_if_the_kernel_allows(case):
    rng = np.random.default_rng(0)
    assert _plan(case(rng, n_outputs=5, n_times=600, masks="complete")) == "state-space"
    assert _plan(case(rng, n_outputs=5, n_times=600, masks="complete", kernel="rbf")) != (
        "state-space"
    )


@pytest.mark.parametrize("name", ["dense", "latent-split", "state-space"])
def test_a_named_solver_is_taken(name, case):
    assert _plan(case(np.random.default_rng(0)), name) == name
