"""Files that lie beside the repository and are no part of it."""

import os
from pathlib import Path

import pytest

BESIDE = Path(__file__).resolve().parents[3] / "shared"


def shared_like(pattern):
    """Return the files below that folder whose names match; none where the folder is absent."""
    return sorted(Path(os.environ.get("MOCAPBENCH_SHARED") or BESIDE).glob(pattern))


def shared(*parts):
    """Return a path below the folder that MOCAPBENCH_SHARED names, or ``../shared``; else skip."""
    path = Path(os.environ.get("MOCAPBENCH_SHARED") or BESIDE).joinpath(*parts)
    if not path.exists():
        pytest.skip(f"{Path(*parts)} is in no folder ../shared, nor in one of MOCAPBENCH_SHARED")
    return path
