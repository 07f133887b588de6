"""Seeds by identity: the address of a draw decides its seed, whatever else runs.

A stream of random numbers belongs to a problem (task, version, name of the problem, fold), to the
stream's name and, where it belongs to one entrant alone, to the entrant's label. These are hashed
into the spawn key of a `numpy.random.SeedSequence`, so that adding a model, leaving out a case or
reordering jobs changes no other number.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.tasks.address import Address

__all__ = ["Seeds"]


@dataclass(frozen=True)
class Seeds:
    """The random streams of one entrant on one fold.

    Parameters
    ----------
    root : int
        The seed of the whole run.
    address : Address
        Its case is the name of the problem, which several cases may share.

    Examples
    --------
    >>> from mocapbench.benchmark import Address, Seeds
    >>> seeds = Seeds(0, Address("my-task", 1, "my case", fold=2))
    >>> seeds.fold
    2
    >>> bool(seeds.generator("data").random() == seeds.generator("data").random())
    True
    >>> bool(seeds.generator("data").random() == seeds.generator("mask").random())
    False
    """

    root: int
    address: Address

    @property
    def fold(self) -> int:
        """The fold, counted from 0."""
        return self.address.fold or 0

    def of_training(self, training: str) -> Seeds:
        """Return the streams of a fit to recordings of this name; its own if there is no name."""
        shared = self.address._replace(case=training, fold=None)
        return Seeds(self.root, shared) if training else self

    def generator(self, stream: str) -> np.random.Generator:
        """Return the generator of a stream that all entrants share, such as ``data``."""
        return np.random.default_rng(self._sequence(stream))

    def random_state(self, stream: str) -> int:
        """Return an integer seed of the entrant's own stream, ``init`` or ``sample``."""
        return int(self._sequence(stream, self.address.label).generate_state(1)[0])

    def _sequence(self, *streams: str) -> np.random.SeedSequence:
        problem = self.address
        fields = (problem.task, str(problem.version), problem.case, str(self.fold), *streams)
        encoded = [field.encode() for field in fields]
        # Length prefixes keep ("ab", "c") and ("a", "bc") apart.
        message = b"".join(len(field).to_bytes(4, "big") + field for field in encoded)
        words = np.frombuffer(hashlib.sha256(message).digest(), dtype=">u4")
        return np.random.SeedSequence(self.root, spawn_key=tuple(int(word) for word in words))
