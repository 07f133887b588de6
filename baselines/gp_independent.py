"""One Gaussian process a channel: no sharing between channels, nor between recordings.

The kernel's parameters are learnt from all recordings, as independent draws; a prediction rests on
the recording itself. A model that cannot beat it has learnt nothing from the others.
"""

from __future__ import annotations

from mocapbench.baselines.gp.channelwise import Channelwise
from mocapbench.baselines.lmc_independent import LMCIndependent

__all__ = ["GPIndependent"]


class GPIndependent(Channelwise[LMCIndependent]):
    """A Gaussian process and noise for each channel on its own.

    A mapping ``n_components`` has the one key ``"child"``. Parameters and attributes are those of
    `Channelwise`.
    """

    @staticmethod
    def of_one_channel() -> LMCIndependent:
        """Return an unfitted model of one channel."""
        return LMCIndependent(rank=0)
