"""One log-likelihood with its full gradient, each way side by side (`tox -e speed`).

Without ``--benchmark-enable`` each runs once and must agree with the yardstick.
"""

import numpy as np
import pytest

from mocapbench.baselines.gp.planner import PLANS

TOY = ("toy D3 R5", "toy D6 R10, one child", "toy D6 R10, all children")
MOCAP = ("mocap Q1", "mocap Q3")


def _evaluate(problem, plan):
    reduction = problem.reduction
    solver = PLANS[plan](problem.kernel, reduction, problem.parameters)
    return lambda: reduction.evaluate(solver, problem.parameters)


@pytest.mark.parametrize("size", TOY)
@pytest.mark.parametrize("how", ["naive", "dense", "latent-split", "auto"])
def test_toy(benchmark, problem, yardstick, size, how):
    benchmark.group = size
    posed = problem(size)
    ways = {"naive": lambda: yardstick(posed)}
    value, gradient = benchmark(ways.get(how) or _evaluate(posed, how))
    expected, slope = yardstick(posed)
    assert value == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(gradient, slope, rtol=1e-6, atol=1e-6 * np.abs(slope).max())


@pytest.mark.slow
@pytest.mark.parametrize("size", MOCAP)
@pytest.mark.parametrize("how", ["naive", "dense", "latent-split", "state-space"])
def test_mocap(benchmark, problem, yardstick, size, how):
    if benchmark.disabled and how == "naive":
        pytest.skip("the yardstick takes 5 GB and half a minute; run tox -e speed")
    benchmark.group = size
    posed = problem(size)
    ways = {"naive": lambda: yardstick(posed)}
    value, gradient = benchmark.pedantic(ways.get(how) or _evaluate(posed, how), rounds=3)
    reference, slope = _evaluate(posed, "latent-split")()
    assert value == pytest.approx(reference, rel=1e-9)
    np.testing.assert_allclose(gradient, slope, rtol=1e-6, atol=1e-6 * np.abs(slope).max())
