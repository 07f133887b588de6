"""A task file together with the recordings that it was found to name."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.task_files.document import Document
from mocapbench.datasets import named_folders

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

    file: str
    text: str
    folder: str
    tests: tuple[str, ...]
    training: tuple[str, ...]
    complete: bool
    meets: tuple[str, ...]

    @property
    def document(self) -> Document:
        """The TOML."""
        return Document(self.file, self.text)

    def to_plain(self) -> dict[str, Any]:
        """Return what JSON can hold of it."""
        return asdict(self)

    @classmethod
    def from_plain(cls, plain: Mapping[str, Any]) -> Self:
        """Return what `to_plain` turned into ``plain``.

        Raises
        ------
        UsageError
            If it is something else.
        """
        try:
            file, text, folder = (str(plain[name]) for name in ("file", "text", "folder"))
            tests, training = (tuple(map(str, plain[name])) for name in ("tests", "training"))
            complete, meets = bool(plain["complete"]), tuple(map(str, plain["meets"]))
            return cls(file, text, folder, tests, training, complete, meets)
        except (KeyError, TypeError) as error:
            raise UsageError(
                "the plan of the run holds a damaged task file; run `mocapbench run` with "
                "--task-file and --recordings again"
            ) from error


def with_folders(data_dir: Path | None, files: Iterable[TaskFile]) -> Path | None:
    """Return ``data_dir`` with the folders of task files before it, those that are there."""
    own = dict.fromkeys(Path(file.folder) for file in files)
    folders = [*(folder for folder in own if folder.is_dir()), *named_folders(data_dir)]
    return Path(os.pathsep.join(map(str, folders))) if folders else None
