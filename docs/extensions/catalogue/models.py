"""What the page of a model shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from catalogue.docstrings import api_name, described_class
from catalogue.places import Place, two_digits
from mocapbench.benchmark.catalogue.entries import model_entry
from mocapbench.benchmark.registry import MODELS, TASKS, build_unfitted

__all__ = ["model_page"]


def model_page(name: str, found: Sequence[Place]) -> Mapping[str, Any]:
    """Return the values of the template of the model called ``name``.

    Parameters
    ----------
    name : str
    found : sequence of Place
        Where its entrants stand.
    """
    model, unfitted, entry = MODELS.get(name), build_unfitted(name), model_entry(name)
    seconds = sorted(place.seconds for place in found if place.seconds is not None)
    return {
        "name": name,
        "entry": entry,
        "text": described_class(model),
        "defaults": entry["parameters"],
        "api": api_name(model),
        "places": sorted(found, key=lambda place: place.order),
        "findings": _findings(found),
        "fastest": two_digits(seconds[0]) if seconds else "",
        "slowest": two_digits(seconds[-1]) if seconds else "",
        "profiles": sorted({place.profile for place in found}),
        "tasks": [task for task in TASKS.names() if TASKS.get(task).accepts(unfitted)],
    }


def _findings(found: Sequence[Place]) -> Mapping[str, Sequence[Place]]:
    """Return the places that say where the model wins and where it fails, by what they say."""
    findings = {
        "Best": [place for place in found if place.rank == 1],
        "Within 10 % of the best": [place for place in found if place.near],
        "Last": [place for place in found if place.last],
    }
    beaten: dict[str, list[Place]] = {}
    for place in found:
        if place.beaten_by:
            beaten.setdefault(f"No better than {place.beaten_by}", []).append(place)
    return {text: group for text, group in (findings | beaten).items() if group}
