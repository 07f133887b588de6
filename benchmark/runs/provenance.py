"""Provenance: the versions, the machine and the command behind a number."""

from __future__ import annotations

import importlib.metadata
import platform
import shlex
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import scipy.linalg  # noqa: F401  # brings its BLAS, which may be another than NumPy's
from threadpoolctl import threadpool_info

from mocapbench.benchmark.runs.machine import n_cores

__all__ = ["cpu_name", "machine_facts", "provenance"]

_LIBRARIES = ("mocapbench", "numpy", "scipy", "pandas", "scikit-learn")


def provenance(command: Sequence[str], threads: int) -> Mapping[str, str]:
    """Return versions, commit, machine and ``command``, by name.

    Parameters
    ----------
    command : sequence of str
        The command line that started the run.
    threads : int
        Threads of a job.
    """
    versions = {f"{name} version": importlib.metadata.version(name) for name in _LIBRARIES}
    return {
        **versions,
        "commit": _commit(),
        **machine_facts(),
        "threads": f"{threads} per job",
        "command line": shlex.join(command),
    }


def machine_facts() -> Mapping[str, str]:
    """Return what this machine is and what it computes with, by name."""
    return {
        "python version": platform.python_version(),
        "platform": platform.platform(),
        "machine": platform.machine(),
        "libc": " ".join(platform.libc_ver()),
        "BLAS": _blas(),
        "CPU": cpu_name(),
        "cores": str(n_cores()),
    }


def cpu_name() -> str:
    """Return the processor's name, as the system gives it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or "unknown"
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor() or "unknown")


def _blas() -> str:
    """Return the BLAS libraries that are loaded, with the processor family they compute for."""
    names = {
        " ".join(str(pool.get(key)) for key in ("internal_api", "version", "architecture"))
        for pool in threadpool_info()
        if pool["user_api"] == "blas"
    }
    return "; ".join(sorted(names)) or "unknown"


def _commit() -> str:
    """Return the checkout's commit, marked when files differ from it."""
    file = Path(__file__)
    folder = file.parent
    # An installed copy may lie inside somebody else's repository.
    if not _git(folder, "ls-files", "--error-unmatch", file.name):
        return "not a checkout"
    commit = _git(folder, "rev-parse", "HEAD")
    return f"{commit} (modified)" if _git(folder, "status", "--porcelain") else commit


def _git(folder: Path, *arguments: str) -> str:
    try:
        done = subprocess.run(
            ["git", "-C", str(folder), *arguments],
            capture_output=True,
            text=True,
            check=False,
            timeout=10,
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""
