import numpy as np
import pytest

from mocapbench.baselines.gp.solvers.planner import PLANS, solver_names, work


def _plan(example, name="auto"):
    return solver_names(PLANS[name](example.kernel, example.reduction.blocks, example.parameters))


def test_latent_split_is_chosen_for_many_outputs_and_dense_for_few(case):
    rng = np.random.default_rng(0)
    assert _plan(case(rng, n_outputs=3, n_times=50, masks="complete", n_components=2)) == "dense"
    mocap = case(rng, n_outputs=39, n_times=90, masks="complete", n_components=2)
    assert _plan(mocap) == "latent-split"


def test_dense_is_chosen_for_many_patterns(case):
    rng = np.random.default_rng(0)
    example = case(rng, n_replicates=12, n_times=40, masks="frames", kernel="rbf")
    assert _plan(example) == "dense"


def test_state_space_is_chosen_for_many_frames_if_the_kernel_has_a_finite_state(case):
    rng = np.random.default_rng(0)
    assert _plan(case(rng, n_outputs=5, n_times=600, masks="complete")) == "state-space"
    assert _plan(case(rng, n_outputs=5, n_times=600, masks="complete", kernel="rbf")) != (
        "state-space"
    )


@pytest.mark.parametrize("name", ["dense", "latent-split", "state-space"])
def test_a_named_solver_is_used(name, case):
    assert _plan(case(np.random.default_rng(0)), name) == name


def test_kronecker_is_chosen_for_complete_deviations_in_one_component(case):
    example = case(np.random.default_rng(0), n_outputs=39, n_times=90, masks="complete")
    assert _plan(example) == "kronecker+latent-split"


def test_the_error_of_a_solver_that_cannot_solve_every_block_says_what_it_needs(case):
    rng = np.random.default_rng(0)
    with pytest.raises(ValueError, match=r"every part.*'state-space'.*a Matérn kernel.*'dense'"):
        _plan(case(rng, kernel="rbf"), "state-space")
    with pytest.raises(ValueError, match=r"one component.*complete recordings"):
        _plan(case(rng), "kronecker")


def test_the_work_of_every_solver_is_estimated_for_every_block(case):
    example = case(np.random.default_rng(0), kernel="rbf", masks="complete")
    counted = work(example.kernel, example.reduction.blocks, example.parameters)
    assert len(counted) == len(example.reduction.blocks) == 2
    assert all(set(of_block) == set(PLANS) - {"auto"} for of_block in counted)
    assert [np.isinf(of_block["state-space"]) for of_block in counted] == [True, True]
    assert [np.isinf(of_block["kronecker"]) for of_block in counted] == [True, False]
