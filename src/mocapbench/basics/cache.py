"""The folder of what can be had again: downloads, and environments of models."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs

__all__ = ["find_cache"]


def find_cache(folder: str | Path | None = None) -> Path:
    """Return a folder, or that of the environment's ``MOCAPBENCH_CACHE``, or the user's cache."""
    named = folder or os.environ.get("MOCAPBENCH_CACHE")
    return Path(named or platformdirs.user_cache_dir("mocapbench"))
