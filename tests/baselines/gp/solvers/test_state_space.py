"""Properties of the state-space solver beside those of all solvers."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.baselines.gp.solvers.block import Target
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.solvers.state_space.state_model import StateModel
from mocapbench.baselines.gp.solvers.state_space.state_solver import StateSpace

MATERN = ("matern12", "matern32", "matern52")


@pytest.mark.parametrize("kernel", MATERN)
def test_the_order_of_outputs_does_not_matter(kernel, by, case, with_outputs):
    rng = np.random.default_rng(2)
    example = case(rng, kernel=kernel, n_outputs=4, n_components=2)
    order = rng.permutation(4)
    replicates, parameters = example.replicates, example.parameters
    shuffled = replace(
        example,
        replicates=Replicates(
            replicates.times, replicates.data[:, order], replicates.observed[:, order]
        ),
        parameters=with_outputs(parameters, order),
    )
    value, gradient = example.reduction.evaluate(by(StateSpace, example), parameters)
    other, by_other = shuffled.reduction.evaluate(by(StateSpace, shuffled), shuffled.parameters)
    assert other == pytest.approx(value, rel=1e-12)
    np.testing.assert_allclose(
        by_other, with_outputs(parameters.at(gradient), order).flat, rtol=1e-10, atol=1e-10
    )


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-12])
@pytest.mark.parametrize("kernel", MATERN)
def test_frames_may_be_arbitrarily_close(kernel, gap, case):
    example = case(np.random.default_rng(3), kernel=kernel, n_times=8)
    replicates = example.replicates
    times = replicates.times.copy()
    times[4] = times[3] + gap
    close = replace(
        example, replicates=Replicates(times, replicates.data, replicates.observed)
    ).reduction
    (value, gradient), (expected, slope) = (
        close.evaluate([solver(example.kernel)] * len(close.blocks), example.parameters)
        for solver in (StateSpace, Dense)
    )
    assert value == pytest.approx(expected, rel=1e-10)
    np.testing.assert_allclose(gradient, slope, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("kernel", MATERN)
def test_predictions_are_continuous_across_frames(kernel, case):
    example = case(np.random.default_rng(4), kernel=kernel)
    block = example.reduction.blocks[0]
    posterior = StateSpace(example.kernel).condition(block, example.parameters)
    target = Target({name: np.ones(factor.shape[1]) for name, factor in block.units.items()})
    at = posterior.predict(target, block.times)
    for side in (-1e-10, 1e-10):
        for value, beside in zip(at, posterior.predict(target, block.times + side), strict=True):
            np.testing.assert_allclose(value, beside, atol=1e-8)


@pytest.mark.parametrize("kernel", MATERN)
def test_far_from_the_data_the_posterior_is_the_prior(kernel, case):
    example = case(np.random.default_rng(5), kernel=kernel, n_components=2)
    block = example.reduction.blocks[0]
    posterior = StateSpace(example.kernel).condition(block, example.parameters)
    target = Target({name: np.ones(factor.shape[1]) for name, factor in block.units.items()})
    mean, variance = posterior.predict(target, np.array([-1e6, 1e6]))
    prior = sum(
        target.prior_scale(name) * layer.variances
        for name, layer in example.parameters.layers.items()
    )
    np.testing.assert_allclose(mean, 0.0, atol=1e-12)
    np.testing.assert_allclose(variance, np.stack([prior, prior], axis=1), rtol=1e-12)


def test_observe_adjoint_is_the_adjoint_of_observe(case):
    example = case(np.random.default_rng(6), n_components=2, n_outputs=3)
    block = example.reduction.blocks[0]
    model = StateModel.of(example.kernel, block, example.parameters)
    rng = np.random.default_rng(7)
    states = rng.standard_normal((model.size, 1))
    entries = rng.standard_normal((block.observed[..., 0].size, 1))
    assert np.vdot(entries, model.observe(model.units, states)) == pytest.approx(
        np.vdot(model.observe_adjoint(model.units, entries), states), rel=1e-12
    )


def test_copies_without_noise_are_singular(by, case):
    example = case(np.random.default_rng(8), structure="independent", masks="complete")
    copies = LayerParameters(np.zeros(1), np.ones((1, 2, 1)), np.zeros((1, 2)))
    hopeless = Parameters({"child": copies}, np.full(2, -80.0))
    with pytest.raises(SingularCovarianceError, match=r"raise the noise.*"):
        example.reduction.evaluate(by(StateSpace, example), hopeless)


def test_a_kernel_without_a_finite_state_is_refused(case):
    example = case(np.random.default_rng(9), kernel="rbf")
    solver, block = StateSpace(example.kernel), example.reduction.blocks[0]
    assert solver.work(block, example.parameters) == np.inf
    for method in (solver.evaluate, solver.condition):
        with pytest.raises(ValueError, match=r"expected a kernel with a finite state.*got RBF"):
            method(block, example.parameters)
