"""The dry run of a task file: read every recording, and hide once what every fold hides."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import PurePosixPath

import numpy as np

from mocapbench.baselines.declarations.needs import find_met_needs
from mocapbench.basics.words import format_count
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.task_files.document import Document, TaskFileError
from mocapbench.benchmark.task_files.grouping import check_alike_in_any_order
from mocapbench.benchmark.task_files.hidden_settings import Hidden
from mocapbench.benchmark.task_files.hiding import HidingError, HidingPlace, gap_length
from mocapbench.benchmark.task_files.library import address_of
from mocapbench.benchmark.task_files.own_problem import defined_metrics, own_body
from mocapbench.benchmark.task_files.settings import Settings
from mocapbench.datasets import (
    Archive,
    FormatError,
    Mask,
    Recording,
    RecordingUnavailable,
)

__all__ = ["DryRun"]

_SHOWN = 6


@dataclass(frozen=True)
class DryRun:
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

    def run(
        self, tests: tuple[str, ...], training: tuple[str, ...]
    ) -> tuple[bool, tuple[str, ...]]:
        """Return whether no entry of the recordings is missing, and what needs they meet.

        Parameters
        ----------
        tests, training : tuple of str
            Paths below the folder.

        Raises
        ------
        TaskFileError
            If a recording cannot be read, is unlike the first, or cannot be hidden from as asked,
            or a metric is defined for none of them.
        """
        if self.hidden.pattern:
            self._read("hide.pattern-of", self.hidden.pattern)
        first, complete = self._select_part(tests[0]), True
        undefined = {*self.settings.metrics}
        for path in dict.fromkeys((*tests, *training)):
            recording = self._select_part(path)
            with self._blaming("files", path):
                check_alike_in_any_order(first, recording)
            complete &= bool(recording.visible.all())
            if path in tests:
                problem = self._pose_problems(recording, path)
                undefined.difference_update(defined_metrics(undefined, problem))
        if undefined:
            raise self._undefined_metric_error(min(undefined), tests, problem)
        return complete, tuple(sorted(find_met_needs(problem)))

    def _read(self, key: str, path: str) -> Recording:
        with self._blaming(key, path):
            recording = self.archive.recording(address_of(path, self.settings.rate))
        return replace(recording, name=path)

    def _select_part(self, path: str) -> Recording:
        recording = self._read("files", path)
        selected = self.settings.select(recording)
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

    def _pose_problems(self, recording: Recording, path: str) -> ImputeProblem:
        """Return the problem of the last variant and fold, after all were posed."""
        self._check_lengths(recording, path)
        for _, _, hide in self.hidden.variants:
            for fold in range(self.settings.folds):
                place = HidingPlace(fold, np.random.default_rng(fold), self.archive)
                with self._blaming("hide", path):
                    hidden = hide(recording, place)
                self._check_mask(hidden, recording, path)
        body = own_body(recording, address_of(path, self.settings.rate), self.archive)
        return ImputeProblem.of_one(recording, hidden, body=body)

    def _check_lengths(self, recording: Recording, path: str) -> None:
        """Refuse gaps of different lengths that are as many frames."""
        known: dict[int, float] = {}
        for seconds in self.hidden.lengths:
            with self._blaming("hide.runs.seconds", path):
                length = gap_length(seconds, recording)
            if length in known:
                raise self.document.error(
                    "hide.runs.seconds",
                    f"lengths of different numbers of frames in {path}",
                    f"{known[length]:g} and {seconds:g} s of {format_count(length, 'frame')}",
                    "leave one of them out",
                )
            known[length] = seconds

    def _undefined_metric_error(
        self, name: str, tests: tuple[str, ...], problem: ImputeProblem
    ) -> TaskFileError:
        suffixes = sorted({PurePosixPath(path).suffix for path in tests})
        fitting = defined_metrics(METRICS.names(), problem)
        lacks = " without a whole skeleton" if problem.body is None else ""
        return self.document.error(
            "metrics",
            "metrics that are defined for a recording of the task",
            f"{name!r} for {' and '.join(suffixes)}{lacks}",
            f"choose from {', '.join(fitting)}",
        )

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
