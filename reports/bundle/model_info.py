"""What the report needs to know about the model behind a label."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

__all__ = ["FAMILIES", "ModelInfo", "in_families"]

FAMILIES = (
    "Gaussian processes",
    "Latent dynamics",
    "State space",
    "Alignment",
    "Functional",
    "Across channels",
    "Neighbours",
    "Interpolation",
    "Forecasts",
    "Several models",
    "Your models",
    "References",
)
"""The families of our models, in the order of a report's rows; a plug-in may declare others."""

_YOURS = FAMILIES.index("Your models")
_SEVERAL = FAMILIES.index("Several models")


@dataclass(frozen=True)
class ModelInfo:
    """A model, as an entrant of one task.

    Parameters
    ----------
    name : str
        Name of the model, which several labels may share.
    sentence : str
        What it is; empty for a model that is no longer registered, or says nothing.
    source : str
        The paper it is from, empty where it names none.
    family : str
        The rows of the report under which it stands.
    parameters : str
        Those that the entrant sets, such as ``"n_components=3"``; empty where all are defaults.
    depends_on : str
        What of a motion fills depend on that others leave out, such as its unit.
    """

    name: str
    sentence: str = ""
    source: str = ""
    family: str = FAMILIES[_YOURS]
    parameters: str = ""
    depends_on: str = ""

    @property
    def is_ours(self) -> bool:
        """Whether its family is one of ours: a model of others has none, or one of its own."""
        return self.family in FAMILIES and self.family != FAMILIES[_YOURS]

    @property
    def is_several(self) -> bool:
        """Whether it chooses or averages other models."""
        return self.family == FAMILIES[_SEVERAL]


def in_families(models: Mapping[str, ModelInfo]) -> dict[str, list[str]]:
    """Return the labels of each family, families in the order of the report's rows.

    Parameters
    ----------
    models : mapping of str to ModelInfo
        By label; labels keep their order within a family.
    """
    families = _sort_families(model.family for model in models.values())
    return {
        family: [label for label, model in models.items() if model.family == family]
        for family in families
    }


def _sort_families(families: Iterable[str]) -> list[str]:
    """Return each family once: ours in their order, others in theirs before "Your models"."""
    found = dict.fromkeys(families)
    others = [family for family in found if family not in FAMILIES]
    return [f for f in (*FAMILIES[:_YOURS], *others, *FAMILIES[_YOURS:]) if f in found]
