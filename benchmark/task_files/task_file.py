"""A task file together with the recordings that it was found to name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from mocapbench.benchmark.foreign_files import Name, Text
from mocapbench.benchmark.task_files.document import Document

__all__ = ["TaskFile", "with_folders"]


@dataclass(frozen=True)
class TaskFile:
    """All that a task follows from, as plain values: they travel to workers and stay in a run.

    Parameters
    ----------
    file, text : str
        The TOML file's name, and what it says.
    folder : str
        The folder of recordings.
    tests, training : tuple of str
        Paths below the folder: of the recordings to fill, and of those to learn from.
    complete : bool
        Whether no entry of them is missing, so that models for whole hidden frames can take part.
    meets : tuple of str
        The needs of models that the recordings meet, so that these models can take part.
    """

    file: Name
    text: Text
    folder: Name
    tests: tuple[Name, ...]
    training: tuple[Name, ...]
    complete: bool
    meets: tuple[Name, ...]

    @property
    def document(self) -> Document:
        """The TOML."""
        return Document(self.file, self.text)


def with_folders(folders: Iterable[Path], files: Iterable[TaskFile]) -> tuple[Path, ...]:
    """Return ``folders`` after the folders of task files, those that are there."""
    own = dict.fromkeys(Path(file.folder) for file in files)
    return (*(folder for folder in own if folder.is_dir()), *folders)
