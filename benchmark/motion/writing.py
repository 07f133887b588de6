"""The files that a motion can be written to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from mocapbench.basics.whole_files import write_files
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import require_writable_folder
from mocapbench.benchmark.motion.gif import gif_bytes
from mocapbench.benchmark.motion.joint_angles import amc_text, bvh_text
from mocapbench.benchmark.motion.made import MadeMotion
from mocapbench.datasets import Recording, format_skeleton

__all__ = ["require_new", "write"]


def require_new(files: Mapping[str, Path]) -> None:
    """Refuse files that cannot be written or would be overwritten, before anything is computed.

    Parameters
    ----------
    files : mapping of str to Path
        By format: ``"gif"``, ``"amc"``, ``"bvh"`` or ``"csv"``.

    Raises
    ------
    UsageError
        If there is none, one has another suffix than its format, is there already, or lies in a
        folder that does not exist or cannot be written to.
    """
    if not files:
        raise UsageError("expected a file to write: name one with --gif, --amc, --bvh or --csv")
    for kind, path in files.items():
        if path.suffix.lower() != f".{kind}":
            raise UsageError(f"--{kind}: expected a file called *.{kind}, got {path}")
        if not path.parent.is_dir():
            raise UsageError(f"--{kind}: expected a folder that exists, got {path.parent}")
        require_writable_folder(f"--{kind}", path.parent)
        for written in (path, *([_skeleton_beside(path)] if kind == "amc" else [])):
            if written.exists():
                raise UsageError(
                    f"--{kind}: expected no file called {written}, which would be overwritten; "
                    "name another, or delete it"
                )


def write(motion: MadeMotion, files: Mapping[str, Path], title: str) -> list[Path]:
    """Write all files, or none, and return them.

    Parameters
    ----------
    motion : MadeMotion
    files : mapping of str to Path
        By format; see `require_new`. An .amc file gets its skeleton, an .asf file, beside it.
    title : str
        What a GIF says above the figures.

    Raises
    ------
    UsageError
        If the motion cannot be written in one of the formats.
    """
    contents = _contents(motion, title)
    impossible = [kind for kind in files if kind not in contents]
    if impossible:
        possible = ", ".join(f"--{kind}" for kind in contents)
        raise UsageError(
            f"--{impossible[0]}: expected a task whose channels "
            f"{_NEEDED[impossible[0]]}, and {title} is of another; possible: {possible}"
        )
    written = {
        path: text for kind, named in files.items() for path, text in contents[kind](named).items()
    }
    write_files(written)
    return [*written]


_ANGLES = "are joint angles of a skeleton"
_NEEDED = {"gif": "place joints in space", "amc": _ANGLES, "bvh": _ANGLES}

_Contents = Callable[[Path], Mapping[Path, bytes]]


def _contents(motion: MadeMotion, title: str) -> dict[str, _Contents]:
    """Return what each format that is possible writes to which file."""
    recording, skeleton, picture = motion
    contents: dict[str, _Contents] = {"csv": lambda path: {path: _csv_text(recording).encode()}}
    if picture is not None:
        contents["gif"] = lambda path: {path: gif_bytes(picture, title)}
    if skeleton is not None:
        contents["bvh"] = lambda path: {path: bvh_text(skeleton, recording).encode()}
        contents["amc"] = lambda path: {
            path: amc_text(skeleton, recording).encode(),
            _skeleton_beside(path): format_skeleton(skeleton).encode(),
        }
    return contents


def _skeleton_beside(path: Path) -> Path:
    return path.with_suffix(".asf")


def _csv_text(recording: Recording) -> str:
    """Return a column of times and one a channel, as `CSVFormat` reads them, unrounded."""
    named = zip(recording.channels, recording.units, strict=True)
    names = [f"{channel} [{unit}]" if unit else channel for channel, unit in named]
    rows = np.column_stack([recording.times, recording.values]).tolist()
    lines = [["time", *names], *([repr(value) for value in row] for row in rows)]
    return "\n".join(map(",".join, lines)) + "\n"
