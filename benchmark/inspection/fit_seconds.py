"""Seconds that fits took: those of records, and those of a run of ours."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path

from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.address import Address

__all__ = ["MEASURED", "alike", "of_records", "typical"]

MEASURED = {"smoke": "smoke", "quick": "quick", "paper": "quick"}
"""Of each profile, the one whose fits were measured; those of ``paper`` take longer."""

_TYPICAL = Path(__file__).with_name("typical_seconds.csv")


def alike(address: Address) -> tuple[tuple[str, ...], ...]:
    """Return among what jobs to look for alike ones, the most alike first."""
    return (address.task, address.label), (address.label,), ()


def of_records(records: Iterable[Record]) -> Durations:
    """Return how long the fits of ``records`` took, predictions included."""
    return _learnt(
        (record.address, record.fit_seconds + (record.predict_seconds or 0.0))
        for record in records
        if record.fit_seconds is not None
    )


def _learnt(seconds: Iterable[tuple[Address, float]]) -> Durations:
    durations = Durations()
    for address, each in seconds:
        durations.learn(alike(address), each)
    return durations


def typical(profile: str) -> Durations:
    """Return how long a fit of each entrant took in a run of ours, on one core of a server.

    Parameters
    ----------
    profile : str
        See `MEASURED`.
    """
    with _TYPICAL.open(encoding="utf-8", newline="") as file:
        return _learnt(
            (Address(row["task"], 0, "", 0, row["label"]), float(row["seconds"]))
            for row in csv.DictReader(file)
            if row["profile"] == MEASURED[profile]
        )
