"""Settings of the speed comparisons."""

from __future__ import annotations

import sys
from importlib.metadata import version
from pathlib import Path

# Scripts of this folder run on their own too, where its modules are top-level ones.
sys.path.insert(0, str(Path(__file__).parent))


def pytest_benchmark_update_machine_info(config, machine_info):
    """Record the versions that the figures depend on."""
    machine_info["versions"] = {name: version(name) for name in ("numpy", "scipy", "mocapbench")}
