"""What is installed here that results depend on: the same is expected of every worker."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.metadata import version

from mocapbench.benchmark.entry_points import find_entry_points
from mocapbench.benchmark.registry import REGISTRIES
from mocapbench.benchmark.runs.key_parts import LIBRARIES
from mocapbench.benchmark.runs.source_code.folders import folders_digest

__all__ = ["difference", "installation"]

_LIBRARIES = ("mocapbench", *LIBRARIES)
_PARTS = ("basics", "datasets", "metrics", "baselines", "benchmark")
_SOURCE = "source code of mocapbench"


@cache
def installation() -> Mapping[str, str]:
    """Return the versions of libraries and of packages with plug-ins, and a digest of our code.

    The digest tells apart two checkouts of one version.
    """
    groups = (find_entry_points(registry.group) for registry in REGISTRIES)
    packages = {point.dist.name for points in groups for point in points.values() if point.dist}
    versions = {name: version(name) for name in sorted({*_LIBRARIES, *packages})}
    return {**versions, _SOURCE: folders_digest(_PARTS, "*.py")[:12]}


def difference(expected: Mapping[str, str], found: Mapping[str, str]) -> str:
    """Return in words what of ``found`` is not as expected; nothing if all is."""
    names = (name for name in {**expected, **found} if expected.get(name) != found.get(name))
    return " and ".join(
        f"expected {name} {expected.get(name, 'not to be installed')}, got "
        f"{found.get(name, 'none')}"
        for name in names
    )
