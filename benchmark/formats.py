"""The registered format of a file, and what was measured of all that the file has."""

from __future__ import annotations

import warnings
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.missing_values import tell_missing
from mocapbench.benchmark.registry import FORMATS
from mocapbench.datasets import Format, FormatError, FormatWarning, Recording, unwrap_angles
from mocapbench.datasets.formats.strays import list_measured

__all__ = ["format_for", "read_measured"]


def format_for(path: str | Path) -> Format:
    """Return the format that a file has by its suffix, whose case does not matter.

    Raises
    ------
    FormatError
        If no format has the suffix.
    UsageError
        If several have, or one of them cannot be imported.
    """
    suffix = Path(path).suffix.lower()
    formats = {name: FORMATS.get(name) for name in FORMATS.names()}
    fitting = [name for name, kind in formats.items() if suffix in kind.suffixes]
    if not fitting:
        known = sorted(suffix for kind in formats.values() for suffix in kind.suffixes)
        advice = "export the recording in one of these formats, or add yours with --plugin"
        got = repr(suffix) if suffix else "no suffix"
        raise FormatError(str(path), f"a file of {', '.join(known)}", got, advice)
    if len(fitting) > 1:
        raise UsageError(
            f"{path}: expected one format for {suffix}, got {' and '.join(fitting)}; "
            "remove the package or --plugin of all but one"
        )
    return formats[fitting[0]]()


def read_measured(path: str | Path, rate: float | None = None) -> Recording:
    """Return the recording of a file without what no model is to be judged by.

    These are values that stand for missing ones, which are hidden, results of a model of the body,
    and markers that nobody named. A file that has no other channels keeps those.

    Raises
    ------
    FormatError
        If the file cannot be read.
    UsageError
        As `format_for`.
    """
    file = format_for(path)
    stated = file.read_as_stated(path, rate)
    mask, remarks = tell_missing(stated)
    for text in remarks:
        warnings.warn(f"{stated.name}: {text}", FormatWarning, stacklevel=2)
    recording = unwrap_angles(stated.hide(mask))
    measured = list_measured(recording.channels, file.results(Path(path), recording.channels))
    return recording.select(measured) if measured else recording
