"""Gaussian-process regression of the next frames on the last few."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.common.cholesky import invert
from mocapbench.baselines.common.validation import check_count, check_positive
from mocapbench.baselines.forecasting.windows import (
    WindowByFrameByChannel,
    WindowForecaster,
    follow_last_frame,
    leave_last_frame,
)
from mocapbench.baselines.kriging.mirror_images import mirror_image
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["ProcessForecast"]

_STEPS = ((1, 12.0), (3, 3.0), (9, 1.0))
"""Over how many frames the last pose has moved, and how much each such step counts."""
_BEND, _BEND_WEIGHT = 4, 2.0
"""Half the frames over which the change of a step is taken, and how much it counts."""
_SHARE_OF_A_PART = 0.5
_LEAST_NOISE = 0.2
"""Added to the errors of windows, in shares of their median, before noise follows from them."""


class ProcessForecast(WindowForecaster):
    r"""Predict how the next frames differ from the last one seen, by an exact Gaussian process.

    The covariance of two windows is that of a linear function of the last pose and of its steps,
    plus a rational quadratic one of the distance between them, which has long tails, and half of
    one such for each part of the body, which may move as in one window while others move as in
    another. All outputs share it. A window that the others predict badly, each left out in turn,
    has more noise: thus the process minimises distances rather than their squares. Where names of
    channels tell left from right, it learns from the mirror image of every recording too.

    Windows are taken at intervals so that there are at most ``max_windows``: the cost grows with
    their third power, and memory with their second.

    Parameters
    ----------
    n_seen : int, default=10
        How many frames before the first hidden one it looks at.
    n_ahead : int, default=25
        How many frames it can predict.
    max_windows : int, default=8000
        Largest number of windows to learn from.
    linear : float, default=1.5
        Length in which the linear part counts distances, relative to the spread of windows.
    length : float, default=1.2
        Lengthscale of the other part, relative to the same.
    noise : float, default=0.05
        Variance of what no window tells, relative to that of the other part.
    parts : sequence of sequence of str, default=()
        Of each part of the body, words of which one is in the name of a channel that belongs to
        it, such as ``(("Leg", "Foot"), ("Arm", "Hand"))``.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.

    Notes
    -----
    With x the last pose and its steps of two windows, and S the mean of ‖x‖² over windows,

    .. math::

        k(x, x') = \frac{x^\top x'}{a^2 S} + \frac{1}{1 + \|x - x'\|^2 / 2 \ell^2 S}
        + \frac12 \sum_p \frac{1}{1 + \|x_p - x'_p\|^2 / 2 \ell^2 S_p}

    with :math:`x_p` the channels of part p, and the noise of window i is proportional to its error
    :math:`[K^{-1} Z]_i / [K^{-1}]_{ii}` when it alone is left out.

    References
    ----------
    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press, eqs. 2.25, 4.19 and 5.12.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import ProcessForecast
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(80.0)
    >>> wave = Recording("wave", times, np.sin(times / 3)[:, None], ("knee",), ("cm",))
    >>> given = wave.hide((times > 75)[:, None])
    >>> model = ProcessForecast(n_seen=5, n_ahead=4, noise=1e-4).fit([wave])
    >>> bool(np.abs(model.impute([given])[0].mean - wave.values).max() < 0.02)
    True
    """

    family: ClassVar[str] = "Gaussian processes"

    def __init__(
        self,
        n_seen: int = 10,
        n_ahead: int = 25,
        *,
        max_windows: int = 8000,
        linear: float = 1.5,
        length: float = 1.2,
        noise: float = 0.05,
        parts: Sequence[Sequence[str]] = (),
    ) -> None:
        self.n_seen = n_seen
        self.n_ahead = n_ahead
        self.max_windows = max_windows
        self.linear = linear
        self.length = length
        self.noise = noise
        self.parts = parts

    def _check_parameters(self) -> None:
        check_count("max_windows", self.max_windows, 1)
        for name in ("linear", "length", "noise"):
            check_positive(name, getattr(self, name))
        _check_parts(self.parts)

    def _prepare(self, recordings: Sequence[Recording]) -> Sequence[Recording]:
        """Return the recordings and their mirror images."""
        image = mirror_image(self.channels_)
        return [*recordings, *map(image.of_recording, recordings)] if image else recordings

    def _learn(self, seen: WindowByFrameByChannel, ahead: WindowByFrameByChannel) -> None:
        step = -(-len(seen) // self.max_windows)
        seen, ahead = seen[::step], ahead[::step]
        steps = _describe_steps(seen)
        self._centre = steps.mean(axis=0)
        self._columns = _find_columns(self.channels_, self.parts, steps.shape[1])
        self._spreads = [_find_spread(steps[:, columns]) for columns in self._columns]
        self._known = steps - self._centre
        apart = leave_last_frame(seen, ahead)
        noise = self.noise * self._find_errors(apart)
        self._weights = cho_solve(cho_factor(self._covariance_of_known(noise), lower=True), apart)

    def _predict(self, seen: WindowByFrameByChannel) -> WindowByFrameByChannel:
        steps = _describe_steps(seen) - self._centre
        return follow_last_frame(seen, self._covariance(steps, self._known) @ self._weights)

    def _find_errors(self, apart: Array) -> Array:
        """Return the error (W,) of each window when it is left out, relative to their median."""
        inverse = self._covariance_of_known(np.full(len(apart), self.noise))
        invert(inverse)
        left_out = (inverse @ apart) / np.diagonal(inverse)[:, None]
        errors = np.linalg.norm(left_out, axis=1)
        return np.asarray((errors / (np.median(errors) or 1.0) + _LEAST_NOISE) / (1 + _LEAST_NOISE))

    def _covariance_of_known(self, noise: Array) -> Array:
        covariance = self._covariance(self._known, self._known)
        covariance[np.diag_indices_from(covariance)] += noise
        return covariance

    def _covariance(self, one: Array, other: Array) -> Array:
        whole, *parts = (
            _relate_windows(one[:, columns], other[:, columns], self.length * spread)
            for columns, spread in zip(self._columns, self._spreads, strict=True)
        )
        for part in parts:
            whole += _SHARE_OF_A_PART * part
        whole += (one / (self.linear * self._spreads[0]) ** 2) @ other.T
        return whole


def _relate_windows(one: Array, other: Array, length: float) -> Array:
    """Return the rational quadratic covariance of windows."""
    covariance = np.asarray(euclidean_distances(one, other, squared=True))
    covariance /= 2.0 * length**2
    covariance += 1.0
    return np.asarray(np.reciprocal(covariance, out=covariance))


def _find_spread(steps: Array) -> float:
    """Return the root of the mean squared distance of windows from their mean."""
    return float(np.sqrt(steps.var(axis=0).sum())) or 1.0


def _find_columns(
    channels: Sequence[str], parts: Sequence[Sequence[str]], n_columns: int
) -> list[NDArray[np.bool_]]:
    """Return which columns (5 D,) are of the whole body, and which of each part that is there."""
    belongs = [[any(word in name for word in words) for name in channels] for words in parts]
    repeated = [np.tile(part, n_columns // len(channels)) for part in belongs if any(part)]
    return [np.full(n_columns, True), *repeated]


def _check_parts(parts: object) -> None:
    """Raise ValueError unless it lists words for each part."""
    listed = isinstance(parts, list | tuple) and all(
        isinstance(words, list | tuple) and words and all(isinstance(word, str) for word in words)
        for words in parts
    )
    if not listed:
        raise ValueError(
            f"expected parts to be a list of words for each part of the body, got {parts!r}"
        )


def _describe_steps(seen: WindowByFrameByChannel) -> Array:
    """Return the last pose and its steps, (W, 5 D), by what each counts."""
    last, furthest = seen[:, -1], seen.shape[1] - 1
    steps = [weight * (last - seen[:, furthest - min(back, furthest)]) for back, weight in _STEPS]
    half = min(_BEND, furthest // 2)
    middle, first = (seen[:, furthest - back] for back in (half, 2 * half))
    return np.concatenate([last, *steps, _BEND_WEIGHT * (last - 2.0 * middle + first)], axis=1)
