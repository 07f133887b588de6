"""A whole fit against the best of many (`tox -e speed`)."""

import numpy as np
import pytest
from problems import SIZES, pose

from mocapbench.baselines.mohgp import MOHGP
from mocapbench.datasets import Recording

N_RESTARTS = 20
MAX_ITER = 1000
"""Iterations of a restart; most take one evaluation."""


def recordings(replicates):
    names = [f"output {d}" for d in range(replicates.data.shape[1])]
    values = np.where(replicates.observed, replicates.data, np.nan)
    return [
        Recording(f"replicate {r}", replicates.times, curves.T, names, [""] * len(names))
        for r, curves in enumerate(values)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("size", ["mocap Q1"])
@pytest.mark.parametrize("how", ["fit"])
def test_one_start_comes_near_the_best_of_many(benchmark, size, how):
    if benchmark.disabled:
        pytest.skip("takes minutes: run tox -e speed")
    benchmark.group = f"{size}, fit"
    given = recordings(pose(SIZES[size]).replicates)
    fitted = benchmark.pedantic(MOHGP().fit, args=[given], rounds=1)
    best = MOHGP(n_restarts=N_RESTARTS, max_iter=MAX_ITER, tol=1e-12, random_state=0).fit(given)
    benchmark.extra_info["evaluations"] = fitted.n_evaluations_
    benchmark.extra_info["nats_below_best"] = best.log_likelihood_ - fitted.log_likelihood_
    assert fitted.converged_
    assert best.log_likelihood_ - fitted.log_likelihood_ < 1.0
