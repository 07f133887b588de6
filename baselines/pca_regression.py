"""Regression of hidden channels on visible ones by principal components (relational fill)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings, pool
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.scaling import OwnMeans
from mocapbench.baselines.common.validation import check_positive, check_share
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array, Mask
from mocapbench.basics.mask_runs import frames_alike
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["PCARegression"]


_FRAMES_PER_COMPONENT = 10
"""Complete frames that a component needs: fewer determine no direction (a rule of thumb)."""


class PCARegression(Imputer, Inductive):
    r"""Predict hidden channels of a frame from its visible ones, by principal components.

    Complete frames of all recordings, those of the recording to fill included, give the principal
    axes :math:`V` of frames in which the hidden channels count little (``hidden_weight``), and the
    axes :math:`V_0` of the same frames with the hidden channels set to zero. A frame x with zeros
    at its hidden channels is then reconstructed as :math:`x V_0 (V_0^\top V) V^\top`. As the weight
    tends to 0 this is principal component regression on the visible channels.

    This is strategy R1 of Gløersen and Federolf (2016), applied by itself to every set of channels
    that are hidden together. The number of components is theirs: the axes that hold ``share`` of
    the sum of singular values, in whichever of both sets needs more. It differs in four ways,
    because channels here need not be coordinates of markers. (1) Visible channels all count alike;
    theirs count less the further the marker is from a gap. With equal weights, strategy R2 (one
    marker after the other) has the same limit. (2) Every recording is centred on its own visible
    means, in place of the mean position of its markers in each frame. (3) Recordings given to `fit`
    are used besides the recording to fill, from which alone they learn. (4) There is at most one
    component for ten complete frames.

    It learns nothing over time: frames that are hidden as a whole, and all hidden entries where
    fewer than ten frames are complete, take the recording's own mean of each channel. So does a
    channel in which nothing varies. A channel never visible in a recording takes its mean over the
    recordings given to `fit`. There is no predictive distribution.

    Parameters
    ----------
    hidden_weight : float, default=0.02
        Weight of hidden channels beside the visible ones; positive.
    share : float, default=0.99
        Share of the sum of singular values that the components hold, from 0 to 1.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    References
    ----------
    Ø. Gløersen and P. Federolf (2016), Predicting Missing Marker Trajectories in Human Motion Data
    Using Marker Intercorrelations, PLoS ONE 11(3), e0152616; the defaults are those of the code
    that comes with it.

    P. Federolf (2013), A Novel Approach to Solve the "Missing Marker Problem" in Marker-Based
    Motion Analysis That Exploits the Segment Coordination Patterns in Multi-Limb Motion Data, PLoS
    ONE 8(10), e78689, eq. (1): the reconstruction.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import PCARegression
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(40.0)
    >>> angle = 2 * np.pi * times / 10
    >>> values = np.column_stack([np.sin(angle), 5.0 - 2.0 * np.sin(angle)])
    >>> swing = Recording("swing", times, values, ("hip", "knee"), ("deg", "deg"))
    >>> gap = np.column_stack([times < 0, (times >= 10) & (times < 20)])
    >>> given = swing.hide(gap)
    >>> (prediction,) = PCARegression().fit([given]).impute([given])
    >>> bool(np.abs(prediction.mean - values).max() < 0.01)
    True
    """

    family: ClassVar[str] = "Across channels"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    def __init__(self, hidden_weight: float = 0.02, *, share: float = 0.99) -> None:
        self.hidden_weight = hidden_weight
        self.share = share

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, or a name
            repeats.
        """
        check_positive("hidden_weight", self.hidden_weight)
        check_share("share", self.share)
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording filled, independently of the others given here.

        Raises
        ------
        ValueError
            If channels differ, or a channel is visible neither in a recording nor in those given to
            `fit`.
        """
        check_is_fitted(self)
        check_channels(recordings, self.recordings_[0].channels, self.recordings_[0].units)
        return [
            Prediction.around(recording, self._fill_recording(recording))
            for recording in recordings
        ]

    def _fill_recording(self, recording: Recording) -> FrameByChannel:
        pooled = pool(self.recordings_, [recording])
        own_means = OwnMeans.of(pooled)
        frames = np.concatenate([own_means.apply(other) for other in pooled])
        complete = frames[~np.isnan(frames).any(axis=1)]
        deviations = np.nan_to_num(own_means.apply(recording))
        for rows, hidden in frames_alike(~recording.visible):
            deviations[rows] = deviations[rows] @ self._regression(complete, hidden)
        return own_means.restore(recording, deviations)

    def _regression(self, complete: FrameByChannel, hidden: Mask) -> Array:
        """Return the map (D, D) from a frame with zeros at ``hidden`` channels to all channels."""
        # The scatter of complete frames, in which hidden channels count little, and of the same
        # frames with zeros there, as in the frames to fill.
        weights = np.where(hidden, self.hidden_weight, 1.0)
        scatter = weights[:, None] * (complete.T @ complete) * weights
        values, axes = _principal(scatter)
        visible_values, visible_axes = _principal(scatter * np.outer(~hidden, ~hidden))
        wanted = max(_holding(self.share, each) for each in (values, visible_values))
        n = min(wanted, len(complete) // _FRAMES_PER_COMPONENT, _rank(visible_values))
        # Along the axes of frames with zeros, to those of complete frames, the weights undone.
        axes, visible_axes = axes[:, :n], visible_axes[:, :n]
        return np.asarray(visible_axes @ (visible_axes.T @ axes) @ axes.T / weights)


def _principal(scatter: Array) -> tuple[Array, Array]:
    """Return the singular values (D,) behind a scatter matrix, largest first, and their axes."""
    eigenvalues, axes = np.linalg.eigh(scatter)
    return np.sqrt(np.maximum(eigenvalues[::-1], 0.0)), axes[:, ::-1]


def _holding(share: float, singular_values: Array) -> int:
    """Return the least number of singular values that hold ``share`` of their sum."""
    sums = np.cumsum(singular_values)
    return int(np.searchsorted(sums, share * sums[-1])) + 1


def _rank(singular_values: Array) -> int:
    tolerance = len(singular_values) * np.finfo(np.float64).eps ** 0.5
    return int((singular_values > tolerance * singular_values[0]).sum())
