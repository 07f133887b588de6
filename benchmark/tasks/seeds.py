"""Seeds by identity: what a draw is for decides its seed, never what else runs.

A stream is addressed by the task, its version, the case, the fold, the stream's name and, for what
belongs to one entrant, its label. The address is hashed into a `numpy.random.SeedSequence` spawn
key, so that adding a model, dropping a case or reordering jobs changes nobody's numbers.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

__all__ = ["Seeds"]


@dataclass(frozen=True)
class Seeds:
    """The random streams of one fold.

    Parameters
    ----------
    root : int
        The seed of the whole run.
    task : str
    version : int
    case : str
        Its name, or the question that it shares with others.
    fold : int
        The fold's address.
    """

    root: int
    task: str
    version: int
    case: str
    fold: int

    def sequence(self, stream: str, label: str | None = None) -> np.random.SeedSequence:
        """Return the seed sequence of a stream, ``data``, ``mask`` … or of an entrant's stream."""
        fields = [self.task, str(self.version), self.case, str(self.fold), stream]
        fields += [] if label is None else [label]
        encoded = [field.encode() for field in fields]
        # Length prefixes keep ("ab", "c") and ("a", "bc") apart.
        message = b"".join(len(field).to_bytes(4, "big") + field for field in encoded)
        words = np.frombuffer(hashlib.sha256(message).digest(), dtype=">u4")
        return np.random.SeedSequence(self.root, spawn_key=tuple(int(word) for word in words))

    def generator(self, stream: str) -> np.random.Generator:
        """Return the generator of a stream that every entrant shares."""
        return np.random.default_rng(self.sequence(stream))

    def random_state(self, stream: str, label: str) -> int:
        """Return an integer seed for an entrant's own stream, ``init`` or ``sample``."""
        return int(self.sequence(stream, label).generate_state(1)[0])
