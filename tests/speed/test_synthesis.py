"""Twenty-five new recordings beside one of the same model: what a further sample costs."""

from functools import cache

import numpy as np
import pytest

from mocapbench.baselines.cyclic_alignment import CyclicAlignment
from mocapbench.baselines.gp_independent import GPIndependent
from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.oracle import Oracle
from mocapbench.datasets import ToyProcess

TIMES = np.linspace(0.0, 2.0 * np.pi, 90)
LMC = {"n_components": 3, "max_iter": 3}
MODELS = {
    "mohgp": MOHGP(**LMC),
    "mohgp, posterior": MOHGP(**LMC, sampled_trend="posterior"),
    "moa": MOA(**LMC),
    "lmc-independent": LMCIndependent(**LMC),
    "gp-independent": GPIndependent(max_iter=3),
    "cyclic-alignment": CyclicAlignment(n_styles=2, n_restarts=1, max_iter=3),
    "oracle": Oracle(),
}


@cache
def fitted(name):
    rng = np.random.default_rng(0)
    process = ToyProcess.random(rng, n_outputs=6, noise=0.01)
    model = MODELS[name]
    given = {"process": process} if "true process" in model.needs else {}
    return model.fit(process.draw(rng, TIMES, 5), **given)


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("n_samples", [1, 25])
def test_samples(benchmark, name, n_samples):
    benchmark.group = name
    samples = benchmark(fitted(name).sample, TIMES, n_samples, 0)
    assert samples.shape == (n_samples, 90, 6)
