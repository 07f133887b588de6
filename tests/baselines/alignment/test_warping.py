"""Sequences on a common cycle: prototypes, and groups of those that are alike."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.cycle_start import (
    best_paths,
    prototype,
    prototypes,
    similar_styles,
)
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import random_start
from mocapbench.baselines.common.padded_sequences import Sequences

STEADY = Hyperparameters(0.1, PRIORS["normalised"], closeness=0.1, smoothness=0.1, tol=1e-4)
START = "mocapbench.baselines.alignment.cycle_start"
SIZES = np.array([1.0, 2.0, 1.0, 2.0, 2.0, 1.0, 1.0])


def _aligned(seed):
    """Waves of six frames a cycle and of two sizes, aligned to one cycle."""
    rng = np.random.default_rng(seed)
    phases = [np.arange(20 + k) + rng.uniform(0, 6) for k in range(len(SIZES))]
    waves = [
        size * np.sin(2 * np.pi * phase[:, None] / 6 + np.arange(3))
        for size, phase in zip(SIZES, phases, strict=True)
    ]
    sequences = Sequences.of([wave + 0.05 * rng.normal(size=wave.shape) for wave in waves])
    return random_start(sequences, 12, STEADY, rng), sequences, rng


@pytest.mark.parametrize("seed", range(5))
def test_sequences_that_are_alike_on_the_cycle_share_a_style(seed):
    styles = similar_styles(*_aligned(seed)[:2], 2, _aligned(seed)[2])
    assert len(set(styles)) == 2
    for size in (1.0, 2.0):
        assert len(set(styles[size == SIZES])) == 1


def test_two_sizes_at_two_tempi_are_four_styles_only_by_their_tempi(monkeypatch):
    steps, sizes = np.tile([1.0, 1.5], 6), np.repeat([1.0, 2.0], 6)
    draws = np.random.default_rng(0)
    waves = [
        size * np.sin(2 * np.pi * step * np.arange(60)[:, None] / 8 + np.arange(3) + k)
        + 0.2 * draws.normal(size=(60, 3))
        for k, (step, size) in enumerate(zip(steps, sizes, strict=True))
    ]
    sequences = Sequences.of(waves)

    def kinds():
        """Return how many different pairs there are of a style and a kind of wave."""
        rng = np.random.default_rng(0)
        styles = similar_styles(random_start(sequences, 12, STEADY, rng), sequences, 4, rng)
        return len({*zip(styles, steps, sizes, strict=True)})

    assert kinds() == 4
    monkeypatch.setattr(START + ".tempi", lambda p, _: np.zeros(len(p)))
    assert kinds() > 4


@pytest.mark.parametrize("n_styles", [len(SIZES), 20])
def test_a_sequence_has_a_style_of_its_own_if_there_are_enough(n_styles):
    state, sequences, rng = _aligned(0)
    styles = similar_styles(state, sequences, n_styles, rng)
    assert sorted(styles) == list(range(len(SIZES)))


def test_prototypes_are_those_of_each_sequence():
    state, sequences, _ = _aligned(0)
    paths, trace = best_paths(state, sequences), state.cycles.mean[:, 0]
    cycles = prototypes(paths, sequences, trace)
    for cycle, frames, path in zip(cycles, sequences.arrays(), paths, strict=True):
        np.testing.assert_array_equal(cycle, prototype(frames, path, trace))


def test_a_prototype_averages_the_cycles_and_bridges_what_is_skipped_or_hidden():
    frames = np.array([[0.0], [2.0], [np.nan], [6.0], [8.0]])
    path = np.array([0, 2, 3, 1, 3])  # of five states: once round and on
    cycle = prototype(frames, path, np.full((5, 1), 99.0))
    warped = np.interp(np.arange(9), [0, 2, 6, 8], [0.0, 2.0, 6.0, 8.0])
    expected = [np.mean(warped[m::5]) for m in range(5)]
    np.testing.assert_allclose(cycle[:, 0], expected)


def test_a_prototype_is_the_trace_where_the_sequence_never_comes():
    cycle = prototype(np.array([[1.0], [2.0]]), np.array([1, 2]), np.full((4, 1), 99.0))
    np.testing.assert_array_equal(cycle[:, 0], [99.0, 1.0, 2.0, 99.0])
