"""Every solver, compared with the joint Gaussian of all visible entries and with the others."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.kronecker import Kronecker
from mocapbench.baselines.gp.solvers.latent_split.split_solver import LatentSplit
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.solvers.state_space.state_solver import StateSpace
from mocapbench.baselines.gp.training.coordinates import MIN_NOISE

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
        process = case.process(by(solver, case))
        curve = process.reduction.replicates[replicate]
        ((mean, variance),) = process.infer([curve], [times])
        expected = brute_force(case).posterior(times, replicate, case.structure.layers)
        np.testing.assert_allclose(mean.T, expected[0], atol=1e-8)
        np.testing.assert_allclose(variance.T, expected[1], atol=1e-8)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_trend_conditions_the_joint_gaussian(solver, by, case, brute_force):
    for seed in range(10):
        example = case(np.random.default_rng(seed), n_components=2, n_replicates=4)
        process = example.process(by(solver, example))
        ((mean, variance),) = process.infer([process.reduction.trend], [AT])
        expected = brute_force(example).posterior(AT, None, ("parent",))
        np.testing.assert_allclose(mean.T, expected[0], atol=1e-9)
        np.testing.assert_allclose(variance.T, expected[1], atol=1e-9)


@pytest.mark.parametrize("name", KERNELS)
@pytest.mark.parametrize("solver", SOLVERS[1:])
def test_solvers_agree_at_the_least_noise(solver, name, by, case):
    """Beyond the last frame too: there a smooth kernel's variance rests on its least directions."""
    sizes = {"n_outputs": 8, "n_replicates": 10, "n_times": 40, "rank": 1}
    example = case(np.random.default_rng(0), kernel=name, masks="complete", **sizes)
    phases = np.arange(80.0).reshape(10, 8, 1)
    example.replicates.data[:] = np.sin(example.replicates.times + phases)
    reduction, parameters = example.reduction, example.parameters
    parameters.log_noise[:] = np.log(MIN_NOISE)
    for layer in parameters.layers.values():
        layer.log_lengthscales[:] = 0.4
        layer.weights[:] *= 3.0
        layer.kappa_roots[:] *= 0.01
    times = example.replicates.times[-1] + np.array([-0.7, 0.2, 0.5, 1.5, 4.0])
    curves = [reduction.trend, reduction.replicates[0]]
    (expected, found), (exact, value) = zip(
        *(
            (
                example.process(solvers).infer(curves, [times, times]),
                reduction.evaluate(solvers, parameters)[0],
            )
            for solvers in (by(Dense, example), by(solver, example))
        ),
        strict=True,
    )
    assert value == pytest.approx(exact, rel=1e-9)
    for (mean, variance), (exact_mean, exact_variance) in zip(found, expected, strict=True):
        np.testing.assert_allclose(variance, exact_variance, rtol=1e-4)
        scale = np.abs(exact_mean).max()
        np.testing.assert_allclose(mean, exact_mean, atol=1e-4 * scale)


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
