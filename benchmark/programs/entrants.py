"""The commands that mocapbench brings along, each with a TOML file that has its name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import mocapbench

__all__ = ["find_entrants", "locate_plugin", "name_plugin", "select_entrants"]

_FOLDER = Path(mocapbench.__path__[0]).resolve() / "entrants"


def find_entrants() -> Mapping[str, Path]:
    """Return the TOML files by the names of the models, sorted."""
    return {path.stem: path for path in sorted(_FOLDER.glob("*/*.toml"), key=lambda p: p.stem)}


def select_entrants(names: Iterable[str]) -> tuple[Path, ...]:
    """Return the TOML files of those models among some names that are commands of ours.

    With another seed one has a number after its name.
    """
    known = find_entrants()
    files = dict.fromkeys(known.get(name, known.get(name.rpartition("-")[0])) for name in names)
    return tuple(filter(None, files))


def locate_plugin(named: Path) -> Path:
    """Return the full path of a file, or of the TOML file of a command of ours if that is named."""
    path = named.resolve()
    return path if path.is_file() else find_entrants().get(str(named), path)


def name_plugin(path: Path) -> str:
    """Return how a command line names a file: by the name of the model if it is one of ours."""
    return path.stem if path in find_entrants().values() else str(path)
