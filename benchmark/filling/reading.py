"""How files are read: at which rate, which of their entries count, and which rows are added."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.formats import format_for
from mocapbench.benchmark.missing_values import MissingRule, tell_missing
from mocapbench.datasets import Format, Recording, unwrap_angles

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
    """

    rate: float | None = None
    min_likelihood: float | None = None
    insert_missing: bool = False
    missing: MissingRule = tell_missing

    def format_of(self, path: Path) -> Format:
        """Return the format in which a file is read and written."""
        kind = format_for(path)
        return kind.with_missing_rows() if self.insert_missing else kind

    def read(self, path: Path) -> tuple[Recording, tuple[str, ...]]:
        """Return the recording of a file, and what is to be said of its missing values.

        It has the name of its path, since models want distinct names.
        """
        stated = self.format_of(path).read_as_stated(path, self.rate)
        likely = self._hide_unlikely(path, replace(stated, name=str(path)))
        mask, remarks = self.missing(likely)
        return unwrap_angles(likely.hide(mask)), remarks

    def suggest_likelihoods(self, path: Path) -> str:
        """Return what to add to a message that nothing is hidden, if the file has likelihoods."""
        if self.min_likelihood is not None or self.format_of(path).likelihoods(path) is None:
            return ""
        return "; --min-likelihood 0.6, for instance, fills what the file itself finds less likely"

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
