"""Reading every recording of a task file, and hiding on trial what every fold hides."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.grouping import check_alike_in_any_order
from mocapbench.benchmark.task_files.hidden_settings import Hidden
from mocapbench.benchmark.task_files.hiding import HidingError, Place
from mocapbench.benchmark.task_files.library import address_of
from mocapbench.benchmark.task_files.settings import Settings
from mocapbench.datasets import (
    Archive,
    FormatError,
    Mask,
    Recording,
    RecordingUnavailable,
)

__all__ = ["Facts", "Trial"]

_SHOWN = 6


class Facts(NamedTuple):
    """What recordings have in common that decides which models can fill them."""

    complete: bool
    """Whether no entry of them is missing."""
    has_markers: bool
    """Whether channels are the coordinates of markers or joints."""


@dataclass(frozen=True)
class Trial:
    """Does with recordings what the task will do, and says which key asked for what fails.

    Parameters
    ----------
    document : Document
    settings : Settings
    hidden : Hidden
    archive : Archive
    """

    document: Document
    settings: Settings
    hidden: Hidden
    archive: Archive

    def run(self, tests: tuple[str, ...], training: tuple[str, ...]) -> Facts:
        """Return what models need to know of the recordings.

        Parameters
        ----------
        tests, training : tuple of str
            Paths below the folder.

        Raises
        ------
        TaskFileError
            If a recording cannot be read, is unlike the first, or cannot be hidden from as asked.
        """
        if self.hidden.pattern:
            self._read("hide.pattern-of", self.hidden.pattern)
        first, complete = self._selected(tests[0]), True
        for path in dict.fromkeys((*tests, *training)):
            recording = self._selected(path)
            with self._blaming("files", path):
                check_alike_in_any_order(first, recording)
            complete &= bool(recording.visible.all())
            if path in tests:
                self._hide(recording, path)
        return Facts(complete, bool(markers_of(first.channels, first.units)))

    def _read(self, key: str, path: str) -> Recording:
        with self._blaming(key, path):
            recording = self.archive.recording(address_of(path, self.settings.rate))
        return replace(recording, name=path)

    def _selected(self, path: str) -> Recording:
        recording = self._read("files", path)
        selected = self.settings.selection.of(recording)
        if not selected.channels:
            names = ", ".join(recording.channels[:_SHOWN])
            got = f"none in {path}"
            advice = f"its channels are {names}, …"
            raise self.document.error("channels", "patterns of its channels", got, advice)
        if len(selected.times) < 2:
            expected = f"two or more of the {len(recording.times)} frames of {path}"
            advice = "choose other frames or leave the file out"
            got = f"{len(selected.times)}"
            raise self.document.error("frames", expected, got, advice)
        return selected

    def _hide(self, recording: Recording, path: str) -> None:
        for variant in self.hidden.variants:
            for fold in range(self.settings.folds):
                place = Place(fold, np.random.default_rng(fold), self.archive)
                with self._blaming("hide", path):
                    hidden = variant.hiding.mask(recording, place)
                self._check_mask(hidden, recording, path)

    def _check_mask(self, hidden: Mask, recording: Recording, path: str) -> None:
        """Refuse masks that leave nothing to score, or nothing to see."""
        if not hidden.any():
            advice = "hide more, or leave the file out"
            raise self.document.error("hide", f"some entries of {path} to hide", "none", advice)
        if not (recording.visible & ~hidden).any():
            advice = "hide less"
            raise self.document.error("hide", f"some entries of {path} to see", "none", advice)

    @contextmanager
    def _blaming(self, key: str, path: str) -> Iterator[None]:
        """Turn what a recording has not into an error of the key that asks for it."""
        try:
            yield
        except RecordingUnavailable as error:
            advice = "name a file in the folder of recordings"
            raise self.document.error(key, "a file that is there", repr(path), advice) from error
        except FormatError as error:
            expected = f"for {path} {error.expected}"
            raise self.document.error(key, expected, error.got, error.advice) from error
        except HidingError as error:
            advice = "hide other entries, or leave the file out"
            expected = f"for {path} {error.expected}"
            raise self.document.error(key, expected, error.got, advice) from error
