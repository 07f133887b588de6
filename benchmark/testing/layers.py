"""Checks of models with a trend, with layers and with coregionalisation."""

from __future__ import annotations

import numpy as np

from mocapbench.benchmark.testing.errors import require
from mocapbench.benchmark.testing.subject import COMPLETE, GAP, TIMES, Subject, problem

__all__ = [
    "infers_a_trend_at_any_time",
    "shows_matrices_that_add_up_to_the_covariance",
    "shows_the_covariance_of_every_layer",
]

_CLOSE = 1e-9
_ROUNDING = 1e-6


def infers_a_trend_at_any_time(subject: Subject) -> None:
    """Check that the trend has a mean and a positive variance at any time."""
    times = TIMES[::3] + 0.1
    mean, variance = subject.fit_model(problem(GAP)).trend(times)
    shape = (len(times), COMPLETE[0].values.shape[1])
    shapes = f"{np.shape(mean)} and {np.shape(variance)}"
    whole = np.shape(mean) == np.shape(variance) == shape
    require(whole, f"mean and variance of shape {shape}", shapes, "return them for all channels")
    require(np.isfinite(mean).all(), "a finite mean", "NaN or infinity", "extrapolate")
    least = float(np.min(variance))
    require(least > 0, "a positive variance", f"{least:g}", "leave no time without uncertainty")


def shows_the_covariance_of_every_layer(subject: Subject) -> None:
    """Check that every layer has a symmetric covariance that is positive semi-definite."""
    model = subject.fit_model(COMPLETE)
    require(model.layers, "at least one layer", model.layers, "name them, outermost first")
    side = COMPLETE[0].values.size
    for layer in model.layers:
        covariance = np.asarray(model.covariance(layer, TIMES))
        advice = f"look at covariance({layer!r}, times), outputs slowest"
        require(covariance.shape == (side, side), f"({side}, {side})", covariance.shape, advice)
        skew = float(np.abs(covariance - covariance.T).max())
        require(skew <= _CLOSE * np.trace(covariance), "a symmetric covariance", skew, advice)
        least = float(np.linalg.eigvalsh(covariance).min())
        positive = least > -_ROUNDING * np.trace(covariance)
        require(positive, "no negative eigenvalue", f"{least:g}", advice)


def shows_matrices_that_add_up_to_the_covariance(subject: Subject) -> None:
    """Check that the coregionalisation matrices add up to the covariance at one time."""
    model = subject.fit_model(COMPLETE)
    matrices = model.coregionalisation_
    layers = sorted(model.layers)
    require(sorted(matrices) == layers, f"matrices of {layers}", sorted(matrices), "give them all")
    for layer, components in matrices.items():
        at_one_time = model.covariance(layer, TIMES[:1])
        equal = np.allclose(np.sum(components, axis=0), at_one_time, rtol=_CLOSE, atol=0.0)
        expected = f"matrices of {layer!r} whose sum is its covariance at one time"
        require(equal, expected, components, "give them in the outputs' own units")
