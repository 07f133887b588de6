"""Joint posteriors, compared with the joint Gaussian conditioned on all visible entries."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.reduction.reduction import Replicates
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp.solvers.kronecker import Kronecker
from mocapbench.baselines.gp.solvers.latent_split.split_solver import LatentSplit
from mocapbench.baselines.gp.solvers.state_space.state_solver import StateSpace

SOLVERS = (Dense, LatentSplit, StateSpace, Kronecker)
AT = np.array([1.3, -0.4, 0.7, 5.0, 0.7])
"""Times off the grid, unordered, one of them twice."""


class CountedNoise(np.random.Generator):
    """White noise, with a count of the numbers drawn."""

    def __init__(self):
        super().__init__(np.random.PCG64(0))
        self.count = 0

    def standard_normal(self, shape):
        self.count += int(np.prod(shape))
        return super().standard_normal(shape)


class UnitNoise:
    """White noise whose i-th sample is the i-th unit vector, and whose last sample is zero."""

    def __init__(self, count):
        self.left = np.eye(count + 1, count)

    def standard_normal(self, shape):
        size = int(np.prod(shape)) // len(self.left)
        taken, self.left = np.split(self.left, [size], axis=1)
        return taken.reshape(shape)


def moments_of_draws(process, curve, times):
    """Return the exact mean (D M,) and covariance of draws, which are affine in noise."""
    noise = CountedNoise()
    process.draw(curve, times, 1, noise)
    unit = UnitNoise(noise.count)
    draws = process.draw(curve, times, noise.count + 1, unit)
    assert unit.left.shape[1] == 0
    flat = draws.transpose(0, 2, 1).reshape(len(draws), -1)
    return flat[-1], (flat[:-1] - flat[-1]).T @ (flat[:-1] - flat[-1])


def conditioned(brute_force, case, times):
    """Return mean (R, D M) and covariance (R, D M, R, D M) of all curves at ``times``."""
    data, observed = case.replicates.data, case.replicates.observed
    grid = np.concatenate([case.replicates.times, times])
    shape = (*data.shape[:2], len(grid))
    entire = Replicates(grid, np.zeros(shape), np.ones(shape, dtype=bool))
    noiseless = replace(case.parameters, log_noise=np.full(data.shape[1], -np.inf))
    signal = brute_force(replace(case, replicates=entire)).covariance(noiseless)
    at_times = np.zeros((*data.shape[:2], len(times)), dtype=bool)
    seen = np.concatenate([observed, at_times], axis=2).ravel()
    wanted = np.concatenate([np.zeros_like(observed), ~at_times], axis=2).ravel()
    cross = signal[np.ix_(wanted, seen)]
    gain = np.linalg.solve(brute_force(case).covariance(case.parameters), cross.T).T
    covariance = signal[np.ix_(wanted, wanted)] - gain @ cross.T
    shape = (len(data), data.shape[1] * len(times))
    return (gain @ data[observed]).reshape(shape), covariance.reshape(*shape, *shape)


def posed(case, by, solver, which):
    """Return the process of a case, the curve of a replicate, and its index."""
    process, r = case.process(by(solver, case)), which % len(case.replicates.data)
    return process, process.reduction.replicates[r], r


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_covariance_conditions_the_joint_gaussian(solver, by, served, brute_force):
    @settings(deadline=None)
    @given(served(solver), st.integers(0, 3))
    def law(case, which):
        times = np.concatenate([AT, case.replicates.times])
        process, curve, r = posed(case, by, solver, which)
        covariance = process.covariance(curve, times)
        _, expected = conditioned(brute_force, case, times)
        np.testing.assert_allclose(covariance, expected[r, :, r], atol=1e-8)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_covariance_is_semi_definite_and_has_the_predicted_variances(solver, by, served):
    @settings(deadline=None)
    @given(served(solver), st.integers(0, 3))
    def law(case, which):
        times = np.concatenate([AT, case.replicates.times])
        process, curve, _ = posed(case, by, solver, which)
        covariance = process.covariance(curve, times)
        np.testing.assert_array_equal(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance).min() > -1e-10 * max(1.0, np.trace(covariance))
        ((_, variance),) = process.infer([curve], [times])
        diagonal = np.diagonal(covariance).reshape(-1, len(times)).T
        np.testing.assert_allclose(diagonal, variance, atol=1e-8)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_draws_have_exactly_the_moments_of_the_conditioned_gaussian(
    solver, by, served, brute_force
):
    @settings(deadline=None, max_examples=50)
    @given(served(solver), st.integers(0, 3))
    def law(case, which):
        process, curve, r = posed(case, by, solver, which)
        mean, covariance = moments_of_draws(process, curve, AT)
        expected = conditioned(brute_force, case, AT)
        np.testing.assert_allclose(mean, expected[0][r], atol=1e-8)
        np.testing.assert_allclose(covariance, expected[1][r, :, r], atol=1e-8)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_covariance_between_unseen_replicates_is_the_trends(solver, by, case, brute_force):
    example = case(np.random.default_rng(3), n_components=2, n_replicates=5, masks="complete")
    example.replicates.observed[3:] = False
    example.replicates.data[3:] = 0.0
    process = example.process(by(solver, example))
    unseen_curve = process.reduction.replicates[3]
    _, expected = conditioned(brute_force, example, AT)
    trend = process.covariance(process.reduction.trend, AT)
    np.testing.assert_allclose(trend, expected[3, :, 4], atol=1e-9)
    _, drawn = moments_of_draws(process, process.reduction.trend, AT)
    np.testing.assert_allclose(drawn, trend, atol=1e-9)
    unseen = process.covariance(unseen_curve, AT)
    np.testing.assert_allclose(unseen, expected[3, :, 3], atol=1e-9)
    _, drawn = moments_of_draws(process, unseen_curve, AT)
    np.testing.assert_allclose(drawn, unseen, atol=1e-9)


def test_the_order_of_replicates_does_not_matter(by, cases):
    @settings(deadline=None, max_examples=30)
    @given(cases, st.integers(0, 3), st.integers(0, 2**32 - 1))
    def law(case, which, seed):
        process, curve, r = posed(case, by, Dense, which)
        order = np.random.default_rng(seed).permutation(len(case.replicates.data))
        old = case.replicates
        shuffled = replace(
            case,
            replicates=Replicates(old.times, old.data[order], old.observed[order]),
            paths=case.paths and tuple(case.paths[r] for r in order),
        )
        other, moved, _ = posed(shuffled, by, Dense, int(np.flatnonzero(order == r)[0]))
        np.testing.assert_allclose(
            process.covariance(curve, AT), other.covariance(moved, AT), atol=1e-10
        )

    law()


def test_draws_depend_only_on_the_seed_and_the_times(by, cases):
    @settings(deadline=None, max_examples=30)
    @given(cases, st.integers(0, 3), st.integers(0, 2**32 - 1))
    def law(case, which, seed):
        def draws(solver, times):
            process, curve, _ = posed(case, by, solver, which)
            return process.draw(curve, times, 3, np.random.default_rng(seed))

        first = draws(Dense, AT)
        np.testing.assert_array_equal(first, draws(Dense, AT))
        np.testing.assert_allclose(first[:, 2], first[:, 4], atol=1e-12)
        np.testing.assert_allclose(draws(Dense, AT[::-1]), first[:, ::-1], atol=1e-10)
        for solver in SOLVERS[1:]:
            np.testing.assert_allclose(draws(solver, AT), first, atol=1e-7)

    law()


@pytest.mark.parametrize("solver", SOLVERS)
def test_draws_of_two_terms_have_their_moments(solver, by, case, brute_force):
    example = case(np.random.default_rng(5), n_components=1, n_times=5, masks="complete")
    process, curve, r = posed(example, by, solver, 1)
    assert len(curve) == 2
    n_samples = 20_000
    draws = process.draw(curve, AT[:3], n_samples, np.random.default_rng(1))
    flat = draws.transpose(0, 2, 1).reshape(n_samples, -1)
    mean, covariance = (moment[r] for moment in conditioned(brute_force, example, AT[:3]))
    covariance = covariance[:, r]
    # Five standard errors: √(v / n) of a mean, at most √(2 v w / n) of a covariance.
    variances = np.diagonal(covariance)
    assert (np.abs(flat.mean(axis=0) - mean) < 5 * np.sqrt(variances / n_samples)).all()
    scatter = (flat - mean).T @ (flat - mean) / n_samples
    bound = 5 * np.sqrt(2.0 * np.outer(variances, variances) / n_samples)
    assert (np.abs(scatter - covariance) < bound).all()


class CountingDense(Dense):
    """Counts its calls of `condition` and checks that hidden entries of the data are 0."""

    def __init__(self, kernel):
        super().__init__(kernel)
        self.calls = 0

    def condition(self, block, parameters):
        assert not block.observed.all()
        assert not block.data[:, ~block.observed].any()
        self.calls += 1
        return super().condition(block, parameters)


@pytest.mark.parametrize("structure", ["hierarchical", "pooled", "independent"])
@pytest.mark.parametrize(
    "use",
    [
        lambda process, curve: process.covariance(curve, AT),
        lambda process, curve: process.draw(curve, AT, 25, np.random.default_rng(0)),
    ],
    ids=["covariance", "draw"],
)
def test_each_block_of_a_curve_is_conditioned_once(structure, use, case):
    example = case(np.random.default_rng(0), structure=structure, masks="shared")
    solvers = tuple(CountingDense(example.kernel) for _ in example.reduction.blocks)
    process = example.process(solvers)
    use(process, process.reduction.replicates[0])
    assert [solver.calls for solver in solvers] == [1] * len(solvers)


def test_solvers_may_differ_from_block_to_block(case):
    example = case(np.random.default_rng(2), n_replicates=4, masks="complete")
    curve = example.reduction.replicates[2]
    mixed, dense = (
        example.process((one(example.kernel), two(example.kernel))).covariance(curve, AT)
        for one, two in ((LatentSplit, Kronecker), (Dense, Dense))
    )
    np.testing.assert_allclose(mixed, dense, atol=1e-10)
