"""The cyclic-alignment model beside a plain way of doing the same (`tox -e speed`).

Without ``--benchmark-enable`` each runs once and must agree with the plain way.
"""

import numpy as np
import pytest

from mocapbench.baselines.alignment.chain import forward_backward
from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import run_from_random_start
from mocapbench.baselines.alignment.ring import solve_rings
from mocapbench.baselines.common.padded_sequences import Sequences

N_SEQUENCES, N_FRAMES, N_CHANNELS, N_STATES, N_STYLES, MAX_JUMP = 39, 130, 62, 66, 4, 3


def plain_forward_backward(emission, jumps, frames):
    """The textbook recursions in logarithms, over one sequence after another."""
    results = [
        _one_sequence(evidence[:length], np.log(probabilities))
        for evidence, probabilities, length in zip(emission, jumps, frames.sum(axis=1), strict=True)
    ]
    occupancy = np.zeros_like(emission)
    for row, (posterior, _) in zip(occupancy, results, strict=True):
        row[: len(posterior)] = posterior
    return occupancy, np.array([counts for _, counts in results]), np.zeros(len(emission))


def _one_sequence(emission, log_jumps):
    steps = range(1, len(log_jumps) + 1)
    forward, backward = emission.copy(), np.zeros_like(emission)
    for i in range(1, len(emission)):
        terms = [np.roll(forward[i - 1], j) + log_jumps[j - 1] for j in steps]
        forward[i] += np.logaddexp.reduce(terms)
    for i in range(len(emission) - 2, -1, -1):
        after = emission[i + 1] + backward[i + 1]
        backward[i] = np.logaddexp.reduce([np.roll(after, -j) + log_jumps[j - 1] for j in steps])
    evidence = np.logaddexp.reduce(forward[-1])
    onward = emission[1:] + backward[1:] - evidence
    counts = [
        np.exp(np.roll(forward[:-1], j, axis=1) + onward + log_jumps[j - 1]).sum() for j in steps
    ]
    return np.exp(forward + backward - evidence), counts


def dense_cycles(edge, ground, right):
    """Every cycle's covariance by inversion, one channel of one style after another."""
    n_states, *batch = ground.shape
    identity = np.eye(n_states)
    laplacian = 2.0 * identity - np.roll(identity, 1, axis=0) - np.roll(identity, -1, axis=0)
    mean = np.empty_like(ground)
    for c, f in np.ndindex(*batch):
        covariance = np.linalg.inv(edge * laplacian + np.diag(ground[:, c, f]))
        mean[:, c, f] = covariance @ right[:, c, f]
    return mean


@pytest.fixture(scope="module")
def lattice():
    rng = np.random.default_rng(0)
    frames = np.arange(N_FRAMES) < rng.integers(N_FRAMES // 2, N_FRAMES + 1, N_SEQUENCES)[:, None]
    emission = 20.0 * rng.normal(size=(*frames.shape, N_STATES)) * frames[:, :, None]
    return emission, rng.dirichlet(np.ones(MAX_JUMP), N_SEQUENCES), frames


@pytest.mark.parametrize("way", [plain_forward_backward, forward_backward])
def test_forward_backward(benchmark, lattice, way):
    benchmark.group = "forward-backward, 39 sequences of up to 130 frames"
    occupancy, n_jumps, _ = benchmark(way, *lattice)
    plain, n_plain, _ = plain_forward_backward(*lattice)
    np.testing.assert_allclose(occupancy, plain, atol=1e-9)
    np.testing.assert_allclose(n_jumps, n_plain, atol=1e-8)


@pytest.mark.parametrize(
    "way",
    [dense_cycles, lambda *system: solve_rings(*system).mean],
    ids=["dense_cycles", "ring"],
)
def test_cycles(benchmark, way):
    benchmark.group = "cycles, 66 states, 4 styles, 62 channels"
    rng = np.random.default_rng(0)
    ground = rng.uniform(0.1, 50.0, (N_STATES, N_STYLES, N_CHANNELS))
    right = rng.normal(size=ground.shape)
    np.testing.assert_allclose(
        benchmark(way, 3.0, ground, right), dense_cycles(3.0, ground, right), rtol=1e-9, atol=1e-12
    )


def _sequences(n_sequences, n_frames):
    rng = np.random.default_rng(0)
    phases = rng.uniform(0.0, 2.0 * np.pi, N_CHANNELS)
    angle = 2.0 * np.pi * np.arange(n_frames)[:, None] / 33.0
    return Sequences.of(
        [
            np.sin(angle * rng.uniform(0.9, 1.1) + phases)
            + 0.2 * rng.normal(size=(n_frames, N_CHANNELS))
            for _ in range(n_sequences)
        ]
    )


def _em(n_sequences, n_frames, max_iter):
    hyper = Hyperparameters(
        0.1,
        PRIORS["normalised"],
        closeness=0.01,
        smoothness=0.1,
        max_jump=MAX_JUMP,
        n_styles=N_STYLES,
        n_inner=3,
        tol=-np.inf,
    )
    sequences, rng = _sequences(n_sequences, n_frames), np.random.default_rng(0)
    return run_from_random_start(sequences, N_STATES, hyper, max_iter, rng)


@pytest.mark.slow
def test_em_of_the_papers_size(benchmark):
    benchmark.group = "EM, 15 iterations of 3 sweeps, after 5 with one style"
    best = benchmark.pedantic(_em, (N_SEQUENCES, N_FRAMES, 15), rounds=3)
    assert len(best.objectives) == 16


@pytest.mark.slow
@pytest.mark.parametrize("n_frames", [100, 200, 400, 800])
def test_em_by_frames(benchmark, n_frames):
    benchmark.group = "EM, 3 iterations, 10 sequences, by frames"
    assert len(benchmark.pedantic(_em, (10, n_frames, 3), rounds=3).objectives) == 4


@pytest.mark.slow
@pytest.mark.parametrize("n_sequences", [10, 20, 40, 80])
def test_em_by_sequences(benchmark, n_sequences):
    benchmark.group = "EM, 3 iterations, 100 frames, by sequences"
    assert len(benchmark.pedantic(_em, (n_sequences, 100, 3), rounds=3).objectives) == 4
