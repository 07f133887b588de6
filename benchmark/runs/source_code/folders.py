"""Digests of the folders of our packages, file by file: prose and layout count."""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Iterable
from pathlib import Path

__all__ = ["folders_digest"]


def folders_digest(packages: Iterable[str], pattern: str = "*") -> str:
    """Return a digest of the names and contents of files.

    Parameters
    ----------
    packages : iterable of str
        Packages of ours, such as ``"metrics"``, with all below them.
    pattern : str
        Which files count; those that Python keeps for itself never do.
    """
    digest = hashlib.sha256()
    for package in packages:
        (folder,) = importlib.import_module(f"mocapbench.{package}").__path__
        for path in sorted(Path(folder).rglob(pattern)):
            if path.is_file() and "__pycache__" not in path.parts:
                digest.update(path.relative_to(folder).as_posix().encode())
                digest.update(path.read_bytes())
    return digest.hexdigest()
