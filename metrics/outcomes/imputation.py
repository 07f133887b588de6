"""Truth and prediction of hidden entries."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.metrics.outcomes.arrays import lock_fields, lock_numbers
from mocapbench.metrics.outcomes.poses import ImputedPoses, place

__all__ = ["Imputation"]


@dataclass(frozen=True, eq=False)
class Imputation:
    """Truth and prediction of hidden entries; recordings are concatenated along the frames.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : ndarray of shape (N, D)
        The observed, noisy values, complete.
    mean : ndarray of shape (N, D)
        Predicted values.
    variance : ndarray of shape (N, D) or None
        Predictive variance of an observation, positive at hidden entries.
    hidden : ndarray of bool, shape (N, D)
        The entries to score.
    visible_mean, visible_variance : ndarray of shape (D,)
        Mean and variance (ddof 0) of each output's visible entries over all recordings that the
        model was given: the trivial Gaussian of the MSLL.
    scales : ndarray of shape (D,) or None
        What errors of joint angles in degrees are multiplied by to be comparable, NaN for outputs
        that are not joint angles; None where a task has no such scales.
    units : tuple of D str
        Unit of each output, such as ``"deg"`` or ``"cm"``; empty strings where outputs are scored
        in units of their own.
    place_joints : callable or None
        Places the joints of truth and prediction in space, where the outputs say how; called at
        most once, and only if a metric asks for `poses`.

    Raises
    ------
    ValueError
        If ``hidden`` is not boolean, other fields are not real numbers, or ``units`` is not a
        sequence of strings; if shapes disagree, nothing is hidden, or a hidden entry has no finite
        truth, no finite mean, or a variance that is not positive and finite; on access to `poses`,
        if the outcome has no ``place_joints``.
    """

    truth: Array
    mean: Array
    variance: Array | None
    hidden: NDArray[np.bool_]
    visible_mean: Array
    visible_variance: Array
    scales: Array | None = None
    units: tuple[str, ...] = ()
    place_joints: Callable[[], ImputedPoses] | None = None

    def __post_init__(self) -> None:
        optional = (name for name in ("variance", "scales") if getattr(self, name) is not None)
        lock_numbers(self, "truth", "mean", "visible_mean", "visible_variance", *optional)
        mask = np.asarray(self.hidden)
        if mask.dtype != np.bool_:  # numbers would be taken as frames
            raise ValueError(
                f"expected hidden to be True or False for each entry, got numbers of {mask.dtype}"
            )
        lock_fields(self, hidden=mask)
        self._check_shapes()
        self._check_units()
        self._check_hidden_entries()

    def _check_shapes(self) -> None:
        shape = self.truth.shape
        if len(shape) != 2:
            raise ValueError(f"expected truth of shape (frames, outputs), got {shape}")
        for name, expected in (
            ("mean", shape),
            ("variance", shape),
            ("hidden", shape),
            ("visible_mean", shape[1:]),
            ("visible_variance", shape[1:]),
            ("scales", shape[1:]),
        ):
            array = getattr(self, name)
            if array is not None and array.shape != expected:
                raise ValueError(
                    f"expected {name} of shape {expected} to match truth of shape {shape}, "
                    f"got {array.shape}"
                )

    def _check_units(self) -> None:
        # A single string would be taken as one unit per letter.
        units: object = self.units
        listed = isinstance(units, Sequence | np.ndarray) and not isinstance(units, str)
        if not listed or not all(isinstance(unit, str) for unit in self.units):
            raise ValueError(
                f"expected units to be a sequence of one string per output, got {units!r}"
            )
        if len(self.units) not in (0, self.truth.shape[1]):
            raise ValueError(
                f"expected no units or one for each of {self.truth.shape[1]} outputs, "
                f"got {self.units!r}"
            )

    def _check_hidden_entries(self) -> None:
        if not self.hidden.any():
            raise ValueError("expected at least one hidden entry to score, got none: hide some")
        for name, values in (("truth", self.truth), ("mean", self.mean)):
            bad = int((~np.isfinite(values[self.hidden])).sum())
            if bad:
                raise ValueError(
                    f"expected a finite {name} at hidden entries, got {bad} that are not"
                )
        if self.variance is not None:
            variance = self.variance[self.hidden]
            if not ((variance > 0) & np.isfinite(variance)).all():
                raise ValueError(
                    "expected positive, finite variances at hidden entries, "
                    f"got values from {variance.min():g} to {variance.max():g}"
                )

    @cached_property
    def poses(self) -> ImputedPoses:
        """The joints of truth and prediction in space."""
        return place(self.place_joints)
