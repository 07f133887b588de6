"""What a model can do, as data: the abilities by name, each with words for people.

A model has them in its attribute ``provides``; `mocapbench.baselines.protocols` has the methods
that belong to each.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

__all__ = ["ABILITIES", "IMPLIED", "describe_abilities"]


ABILITIES: Mapping[str, str] = {
    "fills entries": "fills any gaps",
    "fills frames": "fills gaps of whole frames",
    "continues recordings": "continues recordings",
    "fills new recordings": "new recordings too",
    "interpolates": "fills each channel by itself",
    "turns along": "fills joint angles alike wherever a motion stands and faces",
    "moves along": "fills markers alike wherever they stand and face",
    "mirrors along": "fills markers alike if left and right change places",
    "draws samples": "synthesises",
    "clusters": "clusters",
    "aligns": "aligns",
    "blends": "blends",
    "has layers": "gives the covariance of each layer",
    "has coregionalisation": "gives coregionalisation matrices of each layer",
    "has a trend": "gives a common trend",
    "has a latent space": "gives latent positions",
    "has latent dynamics": "gives latent positions with dynamics",
    "replays": "replays training recordings",
}
"""What a model with an ability does, in words for people, in the order of a catalogue."""

IMPLIED: Mapping[str, str] = {
    "fills entries": "fills frames",
    "fills frames": "continues recordings",
    "interpolates": "fills entries",
    "turns along": "fills frames",
    "moves along": "fills frames",
    "mirrors along": "fills frames",
    "blends": "clusters",
    "has coregionalisation": "has layers",
    "has latent dynamics": "has a latent space",
    "replays": "draws samples",
}
"""By an ability, another one that every model with it has."""


def describe_abilities(names: Iterable[str]) -> list[str]:
    """Return the sentences of abilities, without those that follow from another of them.

    Examples
    --------
    >>> from mocapbench.baselines.declarations.abilities import describe_abilities
    >>> describe_abilities({"fills frames", "fills entries", "aligns"})
    ['fills any gaps', 'aligns']
    """
    given = set(names)
    implied = {other for name, other in IMPLIED.items() if name in given}
    return [sentence for name, sentence in ABILITIES.items() if name in given - implied]
