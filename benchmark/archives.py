"""The archive of every registered library of recordings."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from mocapbench.basics.words import join_names
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES
from mocapbench.datasets import Archive

__all__ = [
    "advise_supply",
    "archive_at",
    "explain_fetching",
    "fetch_command",
    "fetch_start",
    "recording_names",
    "require_recordings",
]

_SHOWN = 2
"""Names of recordings in a message, if they are many."""


def archive_at(*folders: str | Path) -> Archive:
    """Return the archive of all libraries, each given the folders that the user names.

    Parameters
    ----------
    *folders : path
        Folders of recordings; without any, each library looks where it looks by default.

    Raises
    ------
    UsageError
        If one of them is not a folder.
    """
    for folder in map(Path, folders):
        if not folder.is_dir():
            raise UsageError(
                f"--data-dir: expected an existing folder of recordings, got {str(folder)!r}; "
                f"name one, or several separated by {os.pathsep!r}, or leave the option out to "
                "download"
            )
    return Archive({name: LIBRARIES.get(name)(*folders) for name in LIBRARIES.names()})


def fetch_command(uris: Iterable[str], plugins: Iterable[Path]) -> str:
    """Return the command that gets recordings, of libraries that plug-in files define too."""
    return f"{fetch_start(plugins)} {shlex.join(recording_names(uris))}"


def explain_fetching(
    uris: Sequence[str], archive: Archive, command: Callable[[Sequence[str], str], str]
) -> str:
    """Return how recordings are got that are not here.

    Parameters
    ----------
    uris : sequence of str
    archive : Archive
    command : callable
        Returns what to say of recordings that can be downloaded, and of "them", or of "2 of them"
        if others cannot, which a user supplies.
    """
    fetched = [uri for uri in uris if not archive.advice(uri)]
    those = "them" if len(fetched) == len(uris) else f"{len(fetched)} of them"
    first = [command(fetched, those)] if fetched else []
    return "; ".join([*first, *advise_supply(uris, archive)])


def advise_supply(uris: Iterable[str], archive: Archive) -> list[str]:
    """Return what to do about recordings that cannot be downloaded, which a user supplies."""
    supplied: dict[str, list[str]] = {}
    for uri in uris:
        supplied.setdefault(archive.advice(uri), []).append(uri)
    return [
        f"{join_names(named, _SHOWN)} cannot be downloaded: {advice}"
        for advice, named in supplied.items()
        if advice
    ]


def fetch_start(plugins: Iterable[Path]) -> str:
    """Return the command that gets recordings up to their names, which may be any."""
    options = "".join(f" --plugin {shlex.quote(str(path))}" for path in plugins)
    return f"{Archive.fetch_command()}{options}"


def recording_names(uris: Iterable[str]) -> tuple[str, ...]:
    """Return recordings as the command that gets them names them, such as ``"35_02"``."""
    return tuple(uri.removeprefix("cmu:") for uri in uris)


def require_recordings(folders: Sequence[Path], archive: Archive) -> None:
    """Refuse folders that the user names if no library finds recordings in any of them.

    Parameters
    ----------
    folders : sequence of Path
        As for `archive_at`; none is never refused.
    archive : Archive
        Whose libraries say how recordings lie in a folder: ``Library.layout``.

    Raises
    ------
    UsageError
        If all folders are empty or hold other things; the message has the layout that is expected.
    """
    layout = [pattern for library in archive.libraries.values() for pattern in library.layout]
    if not folders or any(_holds(folder, layout) for folder in folders):
        return
    got = ", ".join(f"{str(folder)!r}, {_content(folder)}" for folder in folders)
    near = [str(place) for folder in folders for place in _near(folder, layout)]
    raise UsageError(
        f"--data-dir or MOCAPBENCH_DATA: expected recordings ({', '.join(layout)}) in the folder, "
        f"got {got}; name {' or '.join(near) or 'the one that holds them'}, or none to download"
    )


def _holds(folder: Path, layout: Sequence[str]) -> bool:
    return any(next(folder.glob(pattern), None) for pattern in layout)


def _content(folder: Path) -> str:
    return "which holds none" if any(folder.iterdir()) else "which is empty"


def _near(folder: Path, layout: Sequence[str]) -> Iterator[Path]:
    """Yield the folder above and those below that are laid out as expected."""
    below = (place for place in sorted(folder.iterdir()) if place.is_dir())
    for place in (folder.resolve().parent, *below):
        if _holds(place, layout):
            yield place
