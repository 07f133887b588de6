"""How files are read: at which rate, which of their entries count, and which rows are added."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.formats import format_for
from mocapbench.benchmark.missing_values import MissingRule, Told, tell_missing
from mocapbench.datasets import Format, Recording, unwrap_angles
from mocapbench.datasets.formats.strays import list_measured

__all__ = ["Reading"]


class Reading(NamedTuple):
    """How files are read.

    Parameters
    ----------
    rate : float or None
        Frames per second, in place of what the files say.
    min_likelihood : float or None
        Entries that a file finds less likely are hidden.
    insert_missing : bool
        Whether frames of which a file has no row are read as hidden, and rows are added.
    missing : callable
        What tells missing values.
    spikes : callable or None
        What tells spikes, which are hidden.
    """

    rate: float | None = None
    min_likelihood: float | None = None
    insert_missing: bool = False
    missing: MissingRule = tell_missing
    spikes: MissingRule | None = None

    def format_of(self, path: Path) -> Format:
        """Return the format in which a file is read and written."""
        kind = format_for(path)
        return kind.with_missing_rows() if self.insert_missing else kind

    def read(self, path: Path) -> tuple[Recording, tuple[str, ...]]:
        """Return the recording of a file, and what is to be said of its missing values.

        It has the name of its path, since models want distinct names.
        """
        return self.interpret(path, self.format_of(path).read_as_stated(path, self.rate))

    def interpret(self, path: Path, stated: Recording) -> tuple[Recording, tuple[str, ...]]:
        """Return what `read` does, of a file whose format has read it as it is."""
        likely = self._hide_unlikely(path, replace(stated, name=str(path)))
        mask, remarks = self.missing(likely)
        return unwrap_angles(likely.hide(mask)), remarks

    def read_without_spikes(self, path: Path) -> tuple[Recording, tuple[str, ...]]:
        """Return the recording of a file to learn from, as `read` does, with spikes hidden."""
        recording, remarks = self.read(path)
        results = self.format_of(path).results(path, recording.channels)
        spikes, said = self.find_spikes(recording, results)
        if not spikes.any():
            return recording, remarks
        return unwrap_angles(recording.hide(spikes)), (*remarks, *said)

    def suggest_likelihoods(self, path: Path) -> str:
        """Return what to add to a message that nothing is hidden, if the file has likelihoods."""
        if self.min_likelihood is not None or self.format_of(path).likelihoods(path) is None:
            return ""
        return "; --min-likelihood 0.6, for instance, fills what the file itself finds less likely"

    def find_spikes(self, recording: Recording, results: Collection[str]) -> Told:
        """Return which entries are to be hidden as spikes, and what is to be said of them.

        Unlabelled markers and results of a model have none.
        """
        mask = np.zeros(recording.values.shape, dtype=bool)
        if self.spikes is None:
            return mask, ()
        measured = list_measured(recording.channels, results)
        columns = [recording.channels.index(name) for name in measured]
        mask[:, columns], remarks = self.spikes(recording.select(measured))
        return mask, remarks

    def read_as_stated(self, path: Path) -> Recording:
        """Return the recording of a file before missing values are told from others."""
        stated = self.format_of(path).read_as_stated(path, self.rate)
        return self._hide_unlikely(path, replace(stated, name=str(path)))

    def _hide_unlikely(self, path: Path, recording: Recording) -> Recording:
        if self.min_likelihood is None:
            return recording
        likelihoods = self.format_of(path).likelihoods(path)
        if likelihoods is None:
            raise UsageError(
                f"{path}: expected a column of likelihoods for --min-likelihood, such as "
                "'nose.likelihood' beside 'nose.x', got none; leave the option out"
            )
        return recording.hide(likelihoods < self.min_likelihood)
