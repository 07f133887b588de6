"""The task files of several runs as those of one."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from mocapbench.benchmark.task_files.settings import read_settings
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["united_task_files"]


def united_task_files(files: Iterable[TaskFile]) -> tuple[TaskFile, ...]:
    """Return one task file for each name of a task: the first, with the recordings of all.

    That runs with different protocols are not taken for one is for the keys of their jobs to say.
    """
    united: dict[str, TaskFile] = {}
    for file in files:
        name = read_settings(file.document).name
        united[name] = _with_recordings(united.get(name, file), file)
    return tuple(united.values())


def _with_recordings(file: TaskFile, other: TaskFile) -> TaskFile:
    return replace(
        file,
        tests=tuple(dict.fromkeys((*file.tests, *other.tests))),
        training=tuple(dict.fromkeys((*file.training, *other.training))),
        complete=file.complete and other.complete,
    )
