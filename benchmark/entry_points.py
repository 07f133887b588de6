"""Entry points of all installed packages, and whether those of mocapbench are up to date.

pip writes entry points down when it installs. In a clone that is installed by ``pip install -e``,
the code may be newer than they are: a name is then missing, or a model takes part without its
calibration.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.metadata import Distribution, EntryPoint, entry_points
from pathlib import Path

import mocapbench
from mocapbench.basics.words import join_names
from mocapbench.benchmark.errors import UsageError

__all__ = ["find_entry_points", "require_up_to_date"]

_PACKAGE = "mocapbench"
_PROJECT = Path(mocapbench.__file__).parents[2] / "pyproject.toml"
"""Of a clone. Any other installation has none, and the entry points of its own version."""
_MOST_NAMES = 3

_read_installed = cache(entry_points)  # once, as every call reads files of all packages


def find_entry_points(group: str) -> dict[str, EntryPoint]:
    """Return the entry points of a group in all installed packages, by name.

    Raises
    ------
    UsageError
        If mocapbench runs in a clone of which older entry points are installed.
    """
    if _PROJECT.is_file():
        require_up_to_date(_PROJECT)
    return {point.name: point for point in _read_installed().select(group=group)}


@cache
def require_up_to_date(project: Path) -> None:
    """Refuse installed entry points that are not those of a clone.

    Parameters
    ----------
    project : Path
        The clone's ``pyproject.toml``.

    Raises
    ------
    UsageError
        If pip has to install the clone again.
    """
    listed = _read_listed(project)
    installed = {
        (group, point.name, point.value)
        for group in {group for group, _, _ in listed}
        for point in _read_installed().select(group=group)
        if point.dist is not None and _name_distribution(point.dist) == _PACKAGE
    }
    names = dict.fromkeys(f"{name} ({group})" for group, name, _ in sorted(listed ^ installed))
    if names:
        raise UsageError(
            f"expected the entry points of this version of {_PACKAGE}, got those of another, which "
            f"differ in {join_names([*names], _MOST_NAMES)}; run `pip install -e .` again in "
            f"{project.parent}"
        )


@cache  # it is read anew each time, and has a hundred entry points
def _name_distribution(distribution: Distribution) -> str:
    return distribution.name


def _read_listed(project: Path) -> set[tuple[str, str, str]]:
    """Return group, name and value of the entry points in a file; none if it is of another."""
    content = tomllib.loads(project.read_text(encoding="utf-8")).get("project", {})
    groups = content.get("entry-points", {}) if content.get("name") == _PACKAGE else {}
    return {(group, name, value) for group in groups for name, value in groups[group].items()}
