"""Options that several commands have, and what several commands do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from os import pathsep
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.path_lists import named_folders
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import is_writable
from mocapbench.benchmark.programs.entrants import locate_plugin, select_entrants

if TYPE_CHECKING:
    from mocapbench.benchmark import Record, RunDirectory, TaskFile
    from mocapbench.datasets import Archive

__all__ = [
    "DEFAULT_OUT",
    "DataDir",
    "Names",
    "Out",
    "Plugins",
    "cases_named",
    "load_plugins",
    "load_records",
    "load_tasks",
    "open_archive",
    "require_names",
    "require_writable",
    "show_left_out",
    "split",
]

DEFAULT_OUT = Path("mocapbench-results")


def require_names(names: list[str] | None) -> list[str] | None:
    """Refuse an option that names nothing, such as one of a variable that is not set."""
    if names and not all(split([text]) for text in names):
        raise typer.BadParameter("expected names, got none; leave the option out for all")
    return names


Names = Annotated[
    list[str] | None,
    typer.Option(help="Names, repeated or separated by commas.", callback=require_names),
]
Out = Annotated[Path, typer.Option(help="The run directory: new, empty, or an earlier run's.")]
DataDir = Annotated[
    str | None,
    typer.Option(
        envvar="MOCAPBENCH_DATA",
        metavar="PATH",
        help=f"A folder of recordings (subjects/NN/…), or several with {pathsep} between them.",
    ),
]
Plugins = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin",
        "--model-file",
        help="A Python file that defines any of MODELS, TASKS, METRICS, LIBRARIES and FORMATS, or "
        "the TOML file of a model that is a command, or its name in `mocapbench models list`.",
    ),
]


def split(names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the names of an option, however they were separated."""
    parts = (part.strip() for name in names or () for part in name.split(","))
    return tuple(part for part in parts if part)


def cases_named(texts: Sequence[str], tasks: Sequence[str]) -> tuple[str, ...]:
    """Return the cases that an option names, of some tasks or, where none is named, of all.

    Commas separate them, but those within a case's name.
    """
    if not texts:
        return ()
    cases = [case for name in tasks or bench.TASKS.names() for case in bench.TASKS.get(name).cases]
    names = [case.name for case in cases]
    return tuple(case for text in texts for case in bench.split_cases(text, names))


def load_plugins(paths: Sequence[Path] | None, models: Sequence[str] = ()) -> tuple[Path, ...]:
    """Register what files define, and return their full paths.

    Parameters
    ----------
    paths : sequence of Path or None
        The user's own files, or names of commands of ours.
    models : sequence of str, optional
        Names of models, of which commands of ours are registered too.
    """
    named = [locate_plugin(path) for path in paths or ()]
    files = tuple(dict.fromkeys([*named, *select_entrants(models)]))
    if files:  # what checks them takes long to import
        bench.load_plugins(files)
    return files


def load_tasks(store: RunDirectory) -> tuple[TaskFile, ...]:
    """Register the tasks that task files gave to a run, and return these files."""
    files = bench.planned_task_files(store.load_plan())
    bench.add_tasks(files)
    return files


def load_records(store: RunDirectory) -> list[Record]:
    """Return the records of the last run into a directory, of which there must be some."""
    if not (records := store.planned()):
        raise UsageError(f"{store.path} holds no record of its last run; run `mocapbench run`")
    return records


def open_archive(data_dir: str | None, task_files: Sequence[TaskFile] = ()) -> Archive:
    """Return the archive of all libraries, given the folders that the user names.

    Parameters
    ----------
    data_dir : str or None
        The folders, separated by ``os.pathsep``.
    task_files : sequence of TaskFile
        Whose folders have recordings too, as far as they are still there.

    Raises
    ------
    UsageError
        If one of ``data_dir`` is not a folder, or none of them holds recordings.
    """
    folders = named_folders(data_dir)
    bench.require_recordings(folders, bench.archive_at(*folders))
    return bench.archive_at(*bench.with_folders(folders, task_files))


def require_writable(*paths: Path | None) -> None:
    """Refuse a file that cannot be written, before anything is computed for it.

    Raises
    ------
    UsageError
        If a path is a folder, or in a folder that does not exist or cannot be written to.
    """
    for path in filter(None, paths):
        if path.is_dir() or not path.parent.is_dir():
            raise UsageError(f"{path}: expected a file in a folder that exists")
        if not is_writable(path.parent):
            raise UsageError(
                f"{path}: expected a file in a folder that can be written to; name another, or "
                "change the folder's permissions"
            )


def show_left_out(damaged: Iterable[str], console: LiteralConsole) -> None:
    """Name the damaged files of a run directory."""
    for message in dict.fromkeys(damaged):
        console.print(f"damaged, so left out: {message}", soft_wrap=True)
