"""Random problems of the cyclic-alignment model."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.cycle_start import start_em
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import copy_style
from mocapbench.baselines.common.padded_sequences import Sequences


class Problem:
    """Random sequences with a random mask, and the state that EM starts from."""

    def __init__(
        self, seed, *, n_styles=2, n_states=7, max_jump=2, prior="normalised", eta=0.1, hidden=0.3
    ):
        rng = np.random.default_rng(seed)
        arrays = [rng.normal(size=(n, 3)).cumsum(axis=0) for n in rng.integers(1, 15, 4)]
        self.sequences = Sequences.of(
            [np.where(rng.random(a.shape) < hidden, np.nan, a) for a in arrays]
        )
        parent = rng.normal(size=(n_states, 3))
        self.hyper = Hyperparameters(
            eta,
            PRIORS[prior],
            closeness=10.0 ** rng.uniform(-2, 1),
            smoothness=10.0 ** rng.uniform(-2, 2),
            max_jump=max_jump,
        )
        common = start_em(parent, self.sequences, self.hyper)
        self.state = copy_style(common, rng.dirichlet(np.ones(n_styles), 4))


@pytest.fixture(scope="session")
def pose():
    """Return a random problem for a seed and sizes."""
    return Problem
