"""Spikes as missing values, which are then gaps."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.missing_values import Told
from mocapbench.benchmark.recording_checks.file_check import find_faults
from mocapbench.benchmark.recording_checks.visibility import place_markers
from mocapbench.datasets import Recording, unwrap_angles

__all__ = ["tell_spikes"]

_NAMED = 4
"""Markers in a sentence at most."""


def tell_spikes(recording: Recording) -> Told:
    """Return which entries of a recording are in spikes, and a sentence on them."""
    faults = find_faults(unwrap_angles(recording))
    spikes = faults[faults["kind"] == "spike"]
    places = dict(place_markers(recording))
    mask = np.zeros(recording.values.shape, dtype=bool)
    for (name,), start, stop in zip(
        spikes["markers"], spikes["start"], spikes["stop"], strict=True
    ):
        mask[start:stop, places[name]] = True
    if spikes.empty:
        return mask, ("No spike was found to hide.",)
    names = join_names(sorted({name for (name,) in spikes["markers"]}), _NAMED)
    count, are = format_count(len(spikes), "spike"), "is" if len(spikes) == 1 else "are"
    entries = format_count(int(mask.sum()), "entry", "entries")
    return mask, (f"{count} of {names} {are} hidden ({entries}), as --hide-spikes says.",)
