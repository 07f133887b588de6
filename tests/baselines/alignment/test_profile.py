import numpy as np

from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.profile import fit_profile
from mocapbench.baselines.common.padded_sequences import Sequences


def test_em_never_lowers_the_penalised_likelihood():
    rng = np.random.default_rng(0)
    arrays = [rng.normal(size=(n, 3)).cumsum(axis=0) for n in (12, 20, 1)]
    arrays[1][4:9, 1] = np.nan
    hyper = Hyperparameters(0.1, PRIORS["normalised"], max_jump=2, tol=0.0)
    run = fit_profile(
        rng.normal(size=(9, 3)),
        Sequences.of(arrays),
        hyper,
        max_iter=30,
    )
    assert (np.diff(run.objectives) >= -1e-9 * np.abs(run.objectives[1:])).all()
    assert run.objectives[-1] > run.objectives[0] + 1.0
