"""The same in GPy and GPyTorch, which live in an environment of their own (`tox -e peers`)."""

import os
from pathlib import Path

import numpy as np
import pytest
from peer import Peer
from problems import SIZES, pose
from ways import evaluation

PYTHON = os.environ.get("MOCAPBENCH_PEERS")
ROUNDS = 5

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not PYTHON, reason="needs an interpreter with the peers: run tox -e peers"),
]


def compare(benchmark, size, script, folder, rounds):
    problem = pose(SIZES[size])
    benchmark.group = size
    with Peer(PYTHON, script, problem, folder) as peer:
        answer = benchmark.pedantic(peer.evaluate, rounds=rounds, warmup_rounds=1)
    value, gradient = evaluation(problem, "auto")()
    assert answer["value"] == pytest.approx(value, rel=1e-6)
    np.testing.assert_allclose(
        answer["gradient"], gradient, rtol=1e-6, atol=1e-6 * np.abs(gradient).max()
    )
    benchmark.extra_info["peak_mb"] = answer["peak_mb"]


@pytest.mark.parametrize("how", ["GPy"])
@pytest.mark.parametrize("size", ["toy D3 R5", "toy D6 R10, one child", "toy D6 R10, all children"])
def test_gpy(benchmark, size, how, tmp_path):
    compare(benchmark, size, "with_gpy", tmp_path, rounds=ROUNDS)


@pytest.mark.parametrize("how", ["GPy"])
@pytest.mark.parametrize("size", ["mocap Q1"])
def test_gpy_at_the_size_of_recordings(benchmark, size, how, tmp_path):
    if benchmark.disabled:
        pytest.skip("takes 9 GB and a minute: run tox -e peers")
    if available_gb() < 10.0:
        pytest.skip(f"GPy needs 9 GB here, and {available_gb():.1f} GB are free")
    compare(benchmark, size, "with_gpy", tmp_path, rounds=1)


@pytest.mark.parametrize("how", ["GPyTorch"])
@pytest.mark.parametrize("size", ["multitask D39 N90"])
def test_gpytorch(benchmark, size, how, tmp_path):
    compare(benchmark, size, "with_gpytorch", tmp_path, rounds=ROUNDS)


def available_gb():
    lines = Path("/proc/meminfo").read_text().splitlines()
    (line,) = (line for line in lines if line.startswith("MemAvailable:"))
    return int(line.split()[1]) / 2**20
