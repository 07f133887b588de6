"""What a model can do, as data: the abilities by name, each with words for people.

A model has them in its attribute ``provides``; `mocapbench.baselines.protocols` has the methods
that belong to each.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping

__all__ = ["ABILITIES", "DEPENDENCES", "IMPLIED", "describe_abilities", "describe_dependences"]


ABILITIES: Mapping[str, str] = {
    "fills entries": "fills any gaps",
    "fills frames": "fills gaps of whole frames",
    "continues recordings": "continues recordings",
    "fills new recordings": "new recordings too",
    "interpolates": "fills each channel by itself",
    "turns along": "fills joint angles alike wherever a motion stands and faces",
    "moves along": "fills markers alike wherever they stand and face",
    "mirrors along": "fills markers alike if left and right change places",
    "scales along": "fills alike in any unit",
    "resamples along": "fills markers alike at higher frame rates",
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
    "scales along": "continues recordings",
    "resamples along": "fills frames",
    "blends": "clusters",
    "has coregionalisation": "has layers",
    "has latent dynamics": "has a latent space",
    "replays": "draws samples",
}
"""By an ability, another one that every model with it has."""

DEPENDENCES: Mapping[str, str] = {
    "turns along": "where joint angles face",
    "moves along": "where markers stand and face",
    "mirrors along": "which side is left",
    "scales along": "the unit",
    "resamples along": "the frame rate",
}
"""By an ability, what fills depend on of a model that has that from which it follows, but not it.
"""


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


def describe_dependences(names: Iterable[str], needs: Container[str] = ()) -> list[str]:
    """Return what fills depend on of a model with abilities, as far as others may leave it out.

    A model that needs coordinates is given no joint angles.

    Examples
    --------
    >>> from mocapbench.baselines.declarations.abilities import describe_dependences
    >>> describe_dependences({"continues recordings", "scales along"})
    []
    >>> describe_dependences({"continues recordings", "fills frames", "turns along"})[:2]
    ['where markers stand and face', 'which side is left']
    """
    given = set(names)
    open_to = {ability: what for ability, what in DEPENDENCES.items() if IMPLIED[ability] in given}
    if "coordinates" in needs:
        given.add("turns along")
    return [what for ability, what in open_to.items() if ability not in given]
