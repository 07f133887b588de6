"""Which of the real gaps is copied next, so that all get equally many copies."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from mocapbench.benchmark.filling.gaps import Episode

__all__ = ["Turns"]

_COPIES = 10
"""Episodes in a trial, where the recording has fewer and room for more."""


class Turns:
    """Whose turn it is: every episode gets as many copies, over all trials, as every other.

    Parameters
    ----------
    episodes : sequence of Episode
    rng : numpy.random.Generator
        Of the order in which they take turns.
    """

    def __init__(self, episodes: Sequence[Episode], rng: np.random.Generator) -> None:
        self.per_trial = max(_COPIES, len(episodes)) if episodes else 0
        self._episodes, self._rng = episodes, rng
        self._waiting: deque[int] = deque()

    def next(self) -> Episode:
        """Return the episode whose turn it is; the turn stays its own until it is `done`."""
        if not self._waiting:
            self._waiting.extend(self._rng.permutation(len(self._episodes)).tolist())
        return self._episodes[self._waiting[0]]

    def done(self) -> None:
        """Pass the turn on."""
        self._waiting.popleft()
