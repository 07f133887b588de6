"""Markers carried along by the markers around them, as motion-capture software fills gaps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings
from mocapbench.baselines.common.markers import marker_places
from mocapbench.baselines.common.rigid import FEWEST, steadiness
from mocapbench.baselines.common.validation import check_positive
from mocapbench.baselines.interpolation import PchipImputer
from mocapbench.baselines.kriging.body import MarkerBody, to_room
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["RigidBody"]

_BESIDE = 15
"""Frames on both sides of a gap that show whether the others lie on a line."""


class RigidBody(Imputer, Inductive):
    r"""Carry a hidden marker along with those around it, as if they were one rigid body.

    From the last frame a in which a marker is visible, the rigid motion of the other markers
    carries it into the gap, and from the next frame b back into it. What fills the gap goes from
    the one to the other linearly in time; at the beginning and the end of a recording there is one
    of them. Others count the more the less their distance to the marker varies in the recording, by
    the inverse of the standard deviation to a ``power``: markers on the same segment hardly vary.

    The coordinates of a marker are channels such as ``LKNE.x``, ``LKNE.y`` and ``LKNE.z`` that are
    not angles. Other channels, and markers beside which fewer than three are visible throughout a
    gap, are filled as by ``pchip``. Markers on a line do not tell how the body rotates about it:
    the marker is then carried along without such a rotation. There is no predictive distribution.

    Parameters
    ----------
    power : float, default=4
        Positive; the higher, the more the most rigid neighbours count.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    markers_ : ndarray of int of shape (M, 3)
        The places of the coordinates of each marker among the channels.

    Notes
    -----
    With the positions :math:`p_j(t)` of the others, the position :math:`x(a)` of the marker and
    weights :math:`w_j = \operatorname{sd}_t(\lVert p_j - x \rVert)^{-k}`:

    .. math::

        (R_t, c_t) = \arg\min_{R \in SO(3),\, c} \sum_j w_j \lVert R\, p_j(a) + c - p_j(t) \rVert^2,
        \qquad \hat x_a(t) = R_t\, x(a) + c_t

    .. math::

        \hat x(t) = \frac{b - t}{b - a}\, \hat x_a(t) + \frac{t - a}{b - a}\, \hat x_b(t)

    References
    ----------
    W. Kabsch (1976), A Solution for the Best Rotation to Relate Two Sets of Vectors, *Acta
    Crystallographica* A32: the rotation. The weights are of this project.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import RigidBody
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(50) / 50
    >>> turn = np.array([np.cos(6 * times), np.sin(6 * times), 0 * times])
    >>> across = np.array([-turn[1], turn[0], 0 * times])
    >>> up = np.array([0 * times, 0 * times, 1 + times])
    >>> markers = [turn, across, up, turn + across + up]
    >>> names = [f"{marker}.{axis}" for marker in "abcd" for axis in "xyz"]
    >>> values = np.concatenate(markers).T
    >>> body = Recording("body", times, values, names, ("cm",) * 12)
    >>> hidden = np.zeros((50, 12), dtype=bool)
    >>> hidden[10:40, 9:] = True
    >>> given = body.hide(hidden)
    >>> (prediction,) = RigidBody().fit([given]).impute([given])
    >>> bool(np.abs(prediction.mean - values).max() < 0.1)
    True
    """

    family: ClassVar[str] = "Across channels"
    provides: ClassVar[frozenset[str]] = (
        Imputer.provides | Inductive.provides | {"moves along", "mirrors along", "scales along"}
    )
    needs: ClassVar[frozenset[str]] = frozenset({"coordinates"})

    def __init__(self, power: float = 4.0) -> None:
        self.power = power

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn which channels are coordinates of markers.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, or a name
            repeats.
        """
        check_positive("power", self.power)
        checked = check_recordings(recordings)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.markers_: NDArray[np.intp] = marker_places(self.channels_, self.units_)
        self._curves = PchipImputer().fit(checked)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return where the other markers carry each hidden one.

        Raises
        ------
        ValueError
            If channels differ, or a channel has no visible entry in a recording and none in those
            given to `fit`.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        curves = self._curves.impute(recordings)
        return [
            Prediction.around(recording, self._carry_markers(recording, curve.mean.copy()))
            for recording, curve in zip(recordings, curves, strict=True)
        ]

    def _carry_markers(self, recording: Recording, filled: FrameByChannel) -> FrameByChannel:
        """Return ``filled`` (N, D) with the markers that others can carry, where they do."""
        places = recording.values[:, self.markers_]
        hidden = np.asarray(np.isnan(places).any(axis=2))
        for marker in np.flatnonzero(hidden.any(axis=0)).tolist():
            weights = steadiness([places], marker) ** self.power
            for gap in runs(hidden[:, marker]):
                position = _carry_through(recording.times, places, marker, gap, weights)
                if position is not None:
                    filled[np.ix_(gap, self.markers_[marker])] = position
        return filled


def _carry_through(
    times: Array, places: Array, marker: int, gap: NDArray[np.intp], weights: Array
) -> Array | None:
    """Return where others carry a marker through a gap (T, 3); None if they are too few."""
    edges = [frame for frame in (gap[0] - 1, gap[-1] + 1) if 0 <= frame < len(times)]
    beside = places[[*gap, *edges]]
    others = np.flatnonzero(~np.isnan(beside).any(axis=(0, 2)) & (weights > 0.0))
    if len(others) < FEWEST or not edges:
        return None
    near = places[max(gap[0] - _BESIDE, 0) : gap[-1] + _BESIDE + 1, others]
    body = MarkerBody.fit(near[~np.isnan(near).any(axis=(1, 2))], weights[others])
    after = places[np.ix_(gap, others)]
    carried = [
        _carry_marker(body, places[edge, others], after, places[edge, marker]) for edge in edges
    ]
    share = np.interp(times[gap], times[edges], np.arange(len(edges)))[:, None]
    return np.asarray((1.0 - share) * carried[0] + share * carried[-1])


def _carry_marker(body: MarkerBody, before: Array, after: Array, marker: Array) -> Array:
    """Return where motions from ``before`` (K, 3) to ``after`` (T, K, 3) take a marker."""
    start = body.weights @ before
    rotations, ends, _ = MarkerBody(before - start, body.weights, body.rotate).see(after)
    return to_room(np.broadcast_to(marker - start, ends.shape), rotations, ends)
