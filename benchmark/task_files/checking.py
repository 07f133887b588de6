"""Whether a task file fits its recordings, before anything is computed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from mocapbench.basics.words import encodable
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.task_files.building import build_task
from mocapbench.benchmark.task_files.document import Document, TaskFileError
from mocapbench.benchmark.task_files.dry_run import DryRun
from mocapbench.benchmark.task_files.finding import find_tests, find_training
from mocapbench.benchmark.task_files.hidden_settings import Hidden, read_hidden
from mocapbench.benchmark.task_files.library import address_of
from mocapbench.benchmark.task_files.settings import read_settings
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["check_document", "open_task_file", "open_task_files", "require_folder"]


def open_task_files(paths: Sequence[Path], folder: Path | None) -> tuple[TaskFile, ...]:
    """Return the task files that the user names, which fit the folder of recordings; see below.

    Raises
    ------
    UsageError
        If only one of the two is named, or two files define tasks of one name.
    """
    if folder is None and not paths:
        return ()
    if folder is None or not paths:
        raise UsageError(
            "expected --recordings and --task-file together, got only one: name a folder of "
            "recordings and a TOML file of what to hide; "
            f"`mocapbench init my.toml --recordings {folder or 'DIR'}` writes one"
        )
    files = tuple(open_task_file(path, folder) for path in paths)
    names = [read_settings(file.document).name for file in files]
    if len({*names}) < len(names):
        raise UsageError(
            f"--task-file: expected tasks of different names, got {', '.join(names)}; write "
            'name = "…" in one of the files'
        )
    return files


def open_task_file(path: Path, folder: Path) -> TaskFile:
    """Return a task file that fits the recordings of a folder.

    Every recording is read, and what every fold hides is hidden once, in a dry run.

    Parameters
    ----------
    path, folder : Path
        The TOML file and the folder of recordings.

    Raises
    ------
    UsageError
        If the file or the recordings are not as expected; the message has file, line and key.
    """
    require_folder(folder)
    if not path.is_file():
        raise UsageError(
            f"--task-file: expected a TOML file, got {str(path)!r}, which is none; "
            f"`mocapbench init {path} --recordings {folder}` writes one"
        )
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise TaskFileError(f"{path}: expected text in UTF-8, got: {error}; save it so") from error
    return check_document(Document(str(path), text), folder)


def require_folder(folder: Path) -> None:
    """Refuse recordings in what is not a folder, or in one that no list of folders could name.

    Raises
    ------
    UsageError
        If it is so.
    """
    path = str(folder.resolve())
    if not folder.is_dir() or ":" in path or encodable(path) != path:
        raise UsageError(
            "--recordings: expected a folder of recordings whose path is UTF-8 without ':', got "
            f"{str(folder)!r}; name the one that holds your files"
        )


def check_document(document: Document, folder: Path) -> TaskFile:
    """Return the task file of a document that fits a folder; see `open_task_file`."""
    settings = read_settings(document)
    tests = find_tests(document, settings, folder)
    training = find_training(document, settings, tests, folder)
    hidden = read_hidden(document, partial(address_of, rate=settings.rate))
    _check_training(document, hidden, tests, training)
    dry_run = DryRun(document, settings, hidden, archive_at(folder.resolve()))
    complete, meets = dry_run.run(tests, training)
    file = TaskFile(
        document.file,
        document.text,
        str(folder.resolve()),
        tests,
        training,
        complete=complete,
        meets=meets,
    )
    build_task(file)
    return file


def _check_training(
    document: Document, hidden: Hidden, tests: tuple[str, ...], training: tuple[str, ...]
) -> None:
    """Refuse recordings that would be filled without any to learn from, if some were wanted."""
    alone = [test for test in tests if not {*training} - {test}]
    if alone and training:
        raise document.error(
            "training",
            f"recordings besides {alone[0]}",
            "none",
            'write training = "none", or name more files',
        )
    if alone and hidden.whole_channels:
        raise document.error(
            "hide.channels",
            "recordings to learn from, as these channels are hidden from end to end",
            "none",
            'write training = "others", or name frames besides, such as frames = "120:180"',
        )
