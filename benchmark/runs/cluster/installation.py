"""What is installed here that results depend on: the same is expected of every worker."""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points, version
from pathlib import Path

from mocapbench.benchmark.registry import REGISTRIES

__all__ = ["difference", "installation"]

_LIBRARIES = ("mocapbench", "numpy", "scipy", "scikit-learn")
_PARTS = ("datasets", "metrics", "baselines", "benchmark")
_SOURCE = "source code of mocapbench"


@cache
def installation() -> Mapping[str, str]:
    """Return the versions of libraries and of packages with plug-ins, and a digest of our code.

    The digest tells apart two checkouts of one version.
    """
    points = (point for registry in REGISTRIES for point in entry_points(group=registry.group))
    packages = {point.dist.name for point in points if point.dist}
    versions = {name: version(name) for name in sorted({*_LIBRARIES, *packages})}
    return {**versions, _SOURCE: _source_digest()}


def difference(expected: Mapping[str, str], found: Mapping[str, str]) -> str:
    """Return in words what of ``found`` is not as expected; nothing if all is."""
    names = (name for name in {**expected, **found} if expected.get(name) != found.get(name))
    return " and ".join(
        f"expected {name} {expected.get(name, 'not to be installed')}, got "
        f"{found.get(name, 'none')}"
        for name in names
    )


def _source_digest() -> str:
    digest = hashlib.sha256()
    for part in _PARTS:
        (folder,) = importlib.import_module(f"mocapbench.{part}").__path__
        for path in sorted(Path(folder).rglob("*.py")):
            digest.update(path.relative_to(folder).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:12]
