"""Every solver, compared with the joint Gaussian of all visible entries and with the others."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.posterior.prediction import infer
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.kronecker import Kronecker
from mocapbench.baselines.gp.solvers.latent_split.solver import LatentSplit
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.solvers.state_space.solver import StateSpace

SOLVERS = (Dense, LatentSplit, StateSpace, Kronecker)
AT = np.array([-0.4, 0.7, 1.3, 5.0])


def relative(value, expected):
    return np.max(np.abs(value - expected)) / max(1.0, np.max(np.abs(expected)))


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_value_is_that_of_the_joint_gaussian(solver, by, served, brute_force):
    @settings(deadline=None)
    @given(served(solver))
    def law(case):
        value, _ = case.reduction.evaluate(by(solver, case), case.parameters)
        assert relative(value, brute_force(case).log_likelihood(case.parameters)) < 1e-9

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_gradient_is_the_derivative_of_the_joint_gaussian(solver, by, served, brute_force):
    @settings(deadline=None, max_examples=40)
    @given(served(solver))
    def law(case):
        _, gradient = case.reduction.evaluate(by(solver, case), case.parameters)
        assert relative(gradient, brute_force(case).gradient(case.parameters)) < 1e-6

    law()


@pytest.mark.parametrize("solver", SOLVERS[1:])
def test_solvers_agree(solver, by, served):
    @settings(deadline=None)
    @given(served(solver))
    def law(case):
        (one, by_one), (two, by_two) = (
            case.reduction.evaluate(by(method, case), case.parameters) for method in (Dense, solver)
        )
        assert relative(one, two) < 1e-9
        assert relative(by_one, by_two) < 1e-8

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_predictions_condition_the_joint_gaussian(solver, by, served, brute_force):
    @settings(deadline=None)
    @given(served(solver), st.integers(0, 3))
    def law(case, which):
        replicate = which % len(case.replicates.data)
        times = np.concatenate([AT, case.replicates.times])
        reduction = case.reduction
        ((mean, variance),) = infer(
            reduction,
            by(solver, case),
            case.parameters,
            [reduction.replicates[replicate]],
            [times],
        )
        expected = brute_force(case).posterior(times, replicate, case.structure.layers)
        np.testing.assert_allclose(mean.T, expected[0], atol=1e-8)
        np.testing.assert_allclose(variance.T, expected[1], atol=1e-8)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_trend_conditions_the_joint_gaussian(solver, by, case, brute_force):
    for seed in range(10):
        example = case(np.random.default_rng(seed), n_components=2, n_replicates=4)
        reduction = example.reduction
        ((mean, variance),) = infer(
            reduction, by(solver, example), example.parameters, [reduction.trend], [AT]
        )
        expected = brute_force(example).posterior(AT, None, ("parent",))
        np.testing.assert_allclose(mean.T, expected[0], atol=1e-9)
        np.testing.assert_allclose(variance.T, expected[1], atol=1e-9)


@pytest.mark.parametrize("solver", [Dense, LatentSplit])
def test_the_error_of_a_singular_covariance_names_the_cause(solver, by, case):
    example = case(np.random.default_rng(1), kernel="rbf", n_times=20, rank=0, masks="complete")
    flat = example.parameters.flat
    flat[-2:] = -80.0
    hopeless = example.parameters.at(flat)
    for layer in hopeless.layers.values():
        layer.log_lengthscales[:] = 3.0
    with pytest.raises(SingularCovarianceError, match=r"raise the noise.*"):
        example.reduction.evaluate(by(solver, example), hopeless)
