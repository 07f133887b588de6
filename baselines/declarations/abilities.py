"""What a model can do, as data: the abilities by name, each with words for people.

A model has them in its attribute ``provides``; `mocapbench.baselines.protocols` has the methods
that belong to each.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

__all__ = ["ABILITIES", "Ability", "describe_abilities"]


class Ability(NamedTuple):
    """Something that a model can do."""

    sentence: str
    """What the model does, in words for people."""
    implies: str = ""
    """An ability that every model with this one has."""


ABILITIES: Mapping[str, Ability] = {
    "fills entries": Ability("fills any gaps", implies="fills frames"),
    "fills frames": Ability("fills gaps of whole frames"),
    "fills new recordings": Ability("new recordings too"),
    "interpolates": Ability("fills each channel by itself", implies="fills entries"),
    "draws samples": Ability("synthesises"),
    "clusters": Ability("clusters"),
    "aligns": Ability("aligns"),
    "blends": Ability("blends", implies="clusters"),
    "has layers": Ability("gives the covariance of each layer"),
    "has coregionalisation": Ability(
        "gives coregionalisation matrices of each layer", implies="has layers"
    ),
    "has a trend": Ability("gives a common trend"),
    "has a latent space": Ability("gives latent positions"),
    "has latent dynamics": Ability(
        "gives latent positions with dynamics", implies="has a latent space"
    ),
    "replays": Ability("replays training recordings", implies="draws samples"),
}
"""Every ability by its name, in the order in which a catalogue shows them."""


def describe_abilities(names: Iterable[str]) -> list[str]:
    """Return the sentences of abilities, without those that follow from another of them.

    Examples
    --------
    >>> from mocapbench.baselines.declarations.abilities import describe_abilities
    >>> describe_abilities({"fills frames", "fills entries", "aligns"})
    ['fills any gaps', 'aligns']
    """
    given = set(names)
    implied = {ability.implies for name, ability in ABILITIES.items() if name in given}
    return [ability.sentence for name, ability in ABILITIES.items() if name in given - implied]
