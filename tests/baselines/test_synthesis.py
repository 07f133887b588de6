"""New recordings have the distribution stated, and any number of them takes one inference."""

from collections import Counter

import numpy as np
import pytest
from scipy import stats
from scipy.linalg import block_diag, solve_triangular
from sklearn.base import clone

from mocapbench.baselines.alignment import new_motion
from mocapbench.baselines.control import Control
from mocapbench.baselines.cyclic_alignment import CyclicAlignment
from mocapbench.baselines.gp.solvers.dense import Dense
from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.oracle import Oracle
from mocapbench.datasets import ToyProcess

SEEN, NEW = np.linspace(0.0, 5.0, 6), np.array([4.4, 0.3, 2.0])
BOTH = np.concatenate([NEW, SEEN])
N_PAIRS = 400
PROCESS = ToyProcess.random(np.random.default_rng(1), n_outputs=2, noise=0.05)
BRIEF = {"kernel": "rbf", "max_iter": 1}


@pytest.fixture(scope="module")
def recordings():
    """Two complete children and two that show the same half, one output in other units."""
    rng = np.random.default_rng(0)
    children = PROCESS.draw(rng, SEEN, 4)
    hidden = rng.random((6, 2)) < 0.5
    return (*children[:2], *(child.hide(hidden) for child in children[2:]))


def scaled(recordings):
    return [recording.with_values(recording.values * [30.0, 1.0] - 7.0) for recording in recordings]


def split(covariance):
    """Return the blocks (new, new), (new, seen), (seen, seen) of a covariance over `BOTH`."""
    is_new = np.tile(np.arange(len(BOTH)) < len(NEW), 2)
    blocks = (is_new, is_new), (is_new, ~is_new), (~is_new, ~is_new)
    return [covariance[np.ix_(*pair)] for pair in blocks]


def conditioned(recordings, mean, trend, within):
    """Return mean and covariance of g at `NEW`, densely, where y_r = g + f_r + noise.

    ``trend`` is the covariance of g over `BOTH`, ``within`` that of the rest at `SEEN`.
    """
    values = np.concatenate([(r.values - mean).T.ravel() for r in recordings])
    seen, n = ~np.isnan(values), len(recordings)
    new, cross, old = split(trend)
    sigma = np.kron(np.ones((n, n)), old) + np.kron(np.eye(n), within)
    gain = np.linalg.solve(sigma[np.ix_(seen, seen)], np.tile(cross, n)[:, seen].T).T
    at = np.repeat(mean, len(NEW)) + gain @ values[seen]
    return at, new - gain @ np.tile(cross, n)[:, seen].T


def noise_at(times, noise):
    return np.diag(np.repeat(noise, len(times)))


def law(mean, own, shared):
    """Return the moments of two recordings with covariances of their own and one in common."""
    return np.tile(mean, 2), np.kron(np.eye(2), own) + np.kron(np.ones((2, 2)), shared)


def p_values(pairs, mean, covariance):
    """Return how likely the moments of independent ``pairs`` (n, 2, M, D) are under a Gaussian.

    Whitened by the Gaussian's own factor the pairs are standard normal: their mean (Hotelling),
    their squares and their products are tested in turn.
    """
    flat = pairs.transpose(0, 1, 3, 2).reshape(len(pairs), -1)
    white = solve_triangular(np.linalg.cholesky(covariance), (flat - mean).T, lower=True)
    size, n = white.shape
    products = np.tril(white @ white.T, -1) / np.sqrt(n)
    of_mean = stats.chi2.sf(n * (white.mean(axis=1) ** 2).sum(), size)
    of_squares = 2.0 * min(
        stats.chi2.cdf((white**2).sum(), size * n), stats.chi2.sf((white**2).sum(), size * n)
    )
    of_products = stats.chi2.sf((products**2).sum(), size * (size - 1) // 2)
    return np.array([of_mean, of_squares, of_products])


def pairs_from(model):
    """Return pairs of recordings, all of one call: (n, 2, M, D)."""
    return model.sample(NEW, 2 * N_PAIRS, 3).reshape(N_PAIRS, 2, len(NEW), 2)


def pairs_of_calls(model):
    """Return pairs of recordings, each of a call of its own: (n, 2, M, D)."""
    rng = np.random.default_rng(3)
    return np.stack([model.sample(NEW, 2, rng) for _ in range(N_PAIRS)])


@pytest.fixture(scope="module")
def hierarchy(recordings):
    """A fitted MOHGP, and the trend's mean and covariance and a child's covariance at `NEW`."""
    given = scaled(recordings)
    model = MOHGP(**BRIEF).fit(given)
    mean = model.scaling_.mean
    within = model.covariance("child", SEEN) + noise_at(SEEN, model.noise_)
    own = model.covariance("child", NEW) + noise_at(NEW, model.noise_)
    return model, *conditioned(given, mean, model.covariance("parent", BOTH), within), own


def test_children_of_the_mean_trend_differ_by_the_childs_covariance_and_noise(hierarchy):
    model, mean, _, own = hierarchy
    assert p_values(pairs_from(model), *law(mean, own, 0.0 * own)).min() > 1e-3


def test_children_of_a_drawn_trend_are_the_joint_posterior_of_new_replicates(hierarchy, recordings):
    model, mean, covariance, own = hierarchy
    other = clone(model).set_params(sampled_trend="posterior").fit(scaled(recordings))
    pairs = pairs_of_calls(other)
    assert p_values(pairs, *law(mean, own, covariance)).min() > 1e-3
    # The test has the power to tell the two ways apart, and a missing noise from either.
    assert p_values(pairs, *law(mean, own, 0.0 * own)).min() < 1e-6
    noiseless = own - noise_at(NEW, 0.5 * model.noise_)
    assert p_values(pairs, *law(mean, noiseless, covariance)).min() < 1e-6


def test_the_pooled_model_draws_its_prior_around_its_posterior(recordings):
    given = scaled(recordings)
    model = MOA(**BRIEF).fit(given)
    noise = noise_at(SEEN, model.noise_)
    trend = model.covariance("parent", BOTH)
    mean, covariance = conditioned(given, model.scaling_.mean, trend, noise)
    own = model.covariance("parent", NEW) + noise_at(NEW, model.noise_)
    assert p_values(pairs_from(model), *law(mean, own, 0.0 * own)).min() > 1e-3
    pairs = pairs_of_calls(model.set_params(sampled_trend="posterior"))
    assert p_values(pairs, *law(mean, own, covariance)).min() > 1e-3


def test_independent_recordings_are_draws_from_the_prior(recordings):
    model = LMCIndependent(**BRIEF).fit(scaled(recordings))
    own = model.covariance("child", NEW) + noise_at(NEW, model.noise_)
    mean = np.repeat(model.scaling_.mean, len(NEW))
    assert p_values(pairs_from(model), *law(mean, own, 0.0 * own)).min() > 1e-3


def test_independent_channels_do_not_covary(recordings):
    model = GPIndependent(**BRIEF).fit(scaled(recordings))
    own = block_diag(
        *(one.covariance("child", NEW) + noise_at(NEW, one.noise_) for one in model.models_)
    )
    mean = np.repeat([one.scaling_.mean[0] for one in model.models_], len(NEW))
    assert p_values(pairs_from(model), *law(mean, own, 0.0 * own)).min() > 1e-3


def test_the_oracle_draws_new_children_of_the_one_parent_given_the_data(recordings):
    model = Oracle().fit(recordings, PROCESS)
    noise = np.full(2, PROCESS.noise)
    within = PROCESS.child.covariance(SEEN) + noise_at(SEEN, noise)
    parent = PROCESS.parent.covariance(BOTH)
    mean, covariance = conditioned(recordings, np.zeros(2), parent, within)
    own = PROCESS.child.covariance(NEW) + noise_at(NEW, noise)
    pairs = pairs_of_calls(model)
    assert p_values(pairs, *law(mean, own, covariance)).min() > 1e-3
    assert p_values(pairs, *law(mean, own + covariance, 0.0 * own)).min() < 1e-6


def test_the_control_draws_children_of_parents_of_their_own(recordings):
    model = Control().fit(recordings, PROCESS)
    own = PROCESS.covariance(NEW)
    assert p_values(pairs_from(model), *law(np.zeros(6), own, 0.0 * own)).min() > 1e-3


def test_what_the_control_refuses(recordings):
    with pytest.raises(
        ValueError, match="expected a process that generated none of the recordings, got None"
    ):
        Control().fit(recordings)
    with pytest.raises(ValueError, match="2 outputs"):
        Control().fit([recordings[0].select(["output-1"])], PROCESS)


def test_the_trend_to_draw_around_is_checked(recordings):
    with pytest.raises(ValueError, match="sampled_trend"):
        MOHGP(sampled_trend="median").fit(recordings)
    with pytest.raises(ValueError, match="n_samples"):
        MOHGP(max_iter=2).fit(recordings).sample(NEW, 0, 0)


@pytest.mark.parametrize("trend", ["mean", "posterior"])
@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_any_number_of_recordings_takes_one_inference(model, trend, recordings, monkeypatch):
    fitted = model(max_iter=5, solver="dense", sampled_trend=trend).fit(recordings)
    calls = Counter()
    counted(monkeypatch, Dense, "condition", calls)
    counted(monkeypatch, np.linalg, "cholesky", calls)
    fitted.sample(NEW, 1, 0)
    once = dict(calls)
    fitted.sample(NEW, 25, 0)
    assert dict(calls) == {name: 2 * number for name, number in once.items()}


def test_new_sequences_of_one_style_take_one_elimination(recordings, monkeypatch):
    fitted = CyclicAlignment(n_styles=1, n_states=8, n_restarts=1, max_iter=5).fit(recordings)
    calls = Counter()
    counted(monkeypatch, new_motion, "eliminate", calls)
    fitted.sample(np.arange(12.0), 25, 0)
    assert calls == {"eliminate": 1}


def counted(monkeypatch, owner, name, calls):
    """Count the calls of a function of a class or module."""
    function = getattr(owner, name)

    def counting(*arguments, **options):
        calls[name] += 1
        return function(*arguments, **options)

    monkeypatch.setattr(owner, name, counting)
