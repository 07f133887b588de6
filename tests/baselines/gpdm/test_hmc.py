import numpy as np

from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo

SDS = np.array([0.5, 2.0])


def gaussian(x):
    return 0.5 * float(((x / SDS) ** 2).sum()), x / SDS**2


def walled(x):
    """A Gaussian whose factorisation fails on one side."""
    if x[0] > 0.3:
        raise np.linalg.LinAlgError("not positive definite")
    return gaussian(x)


def test_samples_have_the_moments_of_the_density():
    sampler = HybridMonteCarlo(4000, n_burn=50, n_leaps=7, step=0.3)
    samples, accepted = sampler.sample(gaussian, np.zeros(2), np.random.default_rng(0))
    assert samples.shape == (4000, 2)
    assert 0.5 < accepted < 1.0
    np.testing.assert_allclose(samples.mean(axis=0), 0.0, atol=0.15)
    np.testing.assert_allclose(samples.std(axis=0), SDS, rtol=0.1)


def banana(x):
    """x₁ is standard normal and x₂ normal around x₁² − 1: means 0, variances 1 and 3."""
    bent = x[1] - x[0] ** 2 + 1.0
    return 0.5 * float(x[0] ** 2 + bent**2), np.array([x[0] - 2.0 * x[0] * bent, bent])


def test_samples_that_are_kept_leave_a_bent_density_as_it_is():
    """Chains that start with its moments keep them, which they do not where the step adapts."""
    rng, chains = np.random.default_rng(4), []
    sampler = HybridMonteCarlo(25, n_burn=0, n_leaps=10, step=0.3)
    for _ in range(800):
        x, noise = rng.standard_normal(2)
        start = np.array([x, x**2 - 1.0 + noise])
        chains.append(sampler.sample(banana, start, rng)[0])
    np.testing.assert_allclose(np.mean(chains, axis=(0, 1)), 0.0, atol=0.1)
    np.testing.assert_allclose(np.var(chains, axis=(0, 1)), [1.0, 3.0], rtol=0.12)


def test_samples_that_are_discarded_set_the_step():
    for step in (1e-2, 30.0):
        sampler = HybridMonteCarlo(200, n_burn=100, n_leaps=5, step=step)
        _, accepted = sampler.sample(gaussian, np.zeros(2), np.random.default_rng(1))
        assert 0.4 < accepted < 0.95


def test_trajectories_on_which_a_factorisation_fails_are_rejected():
    sampler = HybridMonteCarlo(300, n_burn=0, n_leaps=5, step=0.4)
    samples, accepted = sampler.sample(walled, np.zeros(2), np.random.default_rng(2))
    assert (samples[:, 0] <= 0.3).all()
    assert 0.0 < accepted < 0.9


def test_overflow_is_a_rejection():
    sampler = HybridMonteCarlo(5, n_burn=0, n_leaps=5, step=1e200)
    samples, accepted = sampler.sample(gaussian, np.ones(2), np.random.default_rng(3))
    assert accepted == 0.0
    np.testing.assert_array_equal(samples, np.ones((5, 2)))
