"""One log-likelihood with its full gradient, each way side by side (`tox -e speed`).

Without ``--benchmark-enable`` what is small runs once and must agree with the yardstick.
"""

from functools import cache

import numpy as np
import pytest
from problems import SIZES, pose
from ways import evaluation, measured

TOY = ("toy D3 R5", "toy D6 R10, one child", "toy D6 R10, all children")
MOCAP = ("mocap Q1", "mocap Q3", "multitask D39 N90")
MANY = (
    "mocap Q1 R39",
    "D62 N300 R39, complete",
    "D62 N300 R39, one child",
    "D62 N1000 R39, complete",
    "D62 N1000 R39, one child",
)
MOST_GB = 16.0
STRUCTURED = ("latent-split", "state-space", "auto")


@cache
def reference(size, how):
    return evaluation(pose(SIZES[size]), how)()


def check(result, expected):
    value, gradient = result
    expected_value, slope = expected
    assert value == pytest.approx(expected_value, rel=1e-9)
    np.testing.assert_allclose(gradient, slope, rtol=1e-6, atol=1e-6 * np.abs(slope).max())


@pytest.mark.slow
@pytest.mark.parametrize("size", TOY)
@pytest.mark.parametrize("how", ["naive", "dense", "latent-split", "auto"])
def test_toy(benchmark, size, how):
    benchmark.group = size
    check(benchmark(evaluation(pose(SIZES[size]), how)), reference(size, "naive"))


@pytest.mark.slow
@pytest.mark.parametrize("size", MOCAP)
@pytest.mark.parametrize("how", ["naive", "dense", *STRUCTURED])
def test_mocap(benchmark, size, how):
    if how == "naive" and benchmark.disabled:
        pytest.skip("the yardstick takes gigabytes and half a minute: run tox -e speed")
    benchmark.group = size
    result = benchmark.pedantic(evaluation(pose(SIZES[size]), how), rounds=3, warmup_rounds=1)
    check(result, reference(size, "latent-split"))
    if benchmark.enabled:
        benchmark.extra_info |= measured(SIZES[size], how, most_gb=MOST_GB)


@pytest.mark.slow
@pytest.mark.parametrize("size", MANY)
@pytest.mark.parametrize("how", STRUCTURED)
def test_many(benchmark, size, how):
    if benchmark.disabled:
        pytest.skip("takes gigabytes and up to a minute: run tox -e speed")
    benchmark.group = size
    result = benchmark.pedantic(evaluation(pose(SIZES[size]), how), rounds=2)
    check(result, reference(size, "latent-split"))
    benchmark.extra_info |= measured(SIZES[size], how, most_gb=MOST_GB)
