"""Replay: samples that are the training recordings themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.recordings import by_content, interpolate_channels
from mocapbench.baselines.common.validation import check_sampling
from mocapbench.baselines.protocols import SampleByFrameByChannel, Synthesiser
from mocapbench.datasets import Frames, Recording

__all__ = ["Replay"]


class Replay(Synthesiser):
    r"""Repeat the training recordings as samples, which are real motion but not new.

    The scores of a synthesiser are best read beside those of real recordings, which this model
    provides. Hidden entries, and times between frames, are interpolated linearly; before the first
    and after the last visible entry of a channel the nearest value is held.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    Notes
    -----
    A sample is recording k, drawn with replacement, read at the times t:

    .. math:: x_s(t) = y_{k_s}(t), \qquad k_s \sim U\{1, \ldots, K\}

    References
    ----------
    Not from a publication: a reference level for the synthesis scores of J. D. Gil López (2017),
    Hierarchical Multiple Output Gaussian Processes for Human Motion Data, MSc thesis, Universidad
    Tecnológica de Pereira, §5.2.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import Replay
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(3.0)
    >>> jump = Recording("jump", times, [[0.0], [4.0], [0.0]], ("height",), ("cm",))
    >>> Replay().fit([jump]).sample(np.array([0.5, 1.0]), 2, random_state=0)[:, :, 0]
    array([[2., 4.],
           [2., 4.]])
    """

    family: ClassVar[str] = "References"
    provides: ClassVar[frozenset[str]] = Synthesiser.provides | {"replays"}

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, a name repeats, or a recording has a channel
            without a visible entry.
        """
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
        for recording in self.recordings_:
            _check_visible(recording)
        return self

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return ``n_samples`` of the recordings, drawn with replacement, at ``times`` (N,).

        Raises
        ------
        ValueError
            If times do not increase, or the number of samples or the seed is invalid.
        """
        check_is_fitted(self)
        times = check_sampling(times, n_samples, random_state)
        chosen = np.random.default_rng(random_state).choice(len(self.recordings_), n_samples)
        replayed = np.stack(
            [interpolate_channels(one.values, one.times, times) for one in self.recordings_]
        )
        return np.asarray(replayed[chosen])


def _check_visible(recording: Recording) -> None:
    seen = recording.visible.any(axis=0)
    if not seen.all():
        hidden = [recording.channels[d] for d in np.flatnonzero(~seen)]
        raise ValueError(
            f"recording {recording.name!r}: expected a visible entry of every channel to replay, "
            f"got none of {hidden}; leave the recording or the channels out"
        )
