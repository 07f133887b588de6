"""Checks of synthesisers, clusterers, aligners and blenders."""

from __future__ import annotations

import numpy as np

from mocapbench.benchmark.testing.errors import require, require_equal
from mocapbench.benchmark.testing.subject import COMPLETE, GAP, TIMES, Subject, problem

__all__ = [
    "aligns_every_frame",
    "blends_frame_by_frame",
    "clusters_every_recording",
    "draws_samples",
    "makes_one_cluster_of_one_style",
]

_N_SAMPLES = 3
_N_STYLES = 3
_CLOSE = 1e-9


def draws_samples(subject: Subject) -> None:
    """Check that samples have a shape, are finite, and follow from their seed."""
    model = subject.fit_model(COMPLETE)
    one, two, other = (np.asarray(model.sample(TIMES, _N_SAMPLES, seed)) for seed in (1, 1, 2))
    shape = (_N_SAMPLES, *COMPLETE[0].values.shape)
    advice = "return (n_samples, frames, channels)"
    require(one.shape == shape, f"samples of shape {shape}", one.shape, advice)
    require(np.isfinite(one).all(), "finite samples", "NaN or infinity", "check the covariance")
    require_equal(one, two, "the same samples from the same seed", "draw from random_state alone")
    differs = not np.array_equal(one, other)
    require(differs, "other samples from another seed", "the same", "draw from random_state")


def clusters_every_recording(subject: Subject) -> None:
    """Check that every recording has a cluster, and the same seed gives the same."""
    one, two = (np.asarray(subject.fit_model(problem(GAP)).labels_) for _ in range(2))
    whole = one.shape == (4,) and np.issubdtype(one.dtype, np.integer)
    got = f"shape {one.shape} of {one.dtype}"
    require(whole, "labels_ of 4 integers, one a recording", got, "label recordings, not frames")
    require_equal(one, two, "the same clusters from the same seed", "use random_state alone")


def makes_one_cluster_of_one_style(subject: Subject) -> None:
    """Check that with n_styles=1 all recordings are together."""
    labels = sorted(set(np.asarray(subject.fit_model(COMPLETE, n_styles=1).labels_).tolist()))
    advice = "take n_styles in the constructor and find no more clusters than that"
    require(len(labels) == 1, "one cluster with n_styles=1", labels, advice)


def aligns_every_frame(subject: Subject) -> None:
    """Check that every frame has a state, whether fitted or aligned later."""
    recordings = problem(GAP)
    model = subject.fit_model(recordings)
    one, two = (model.align(recordings) for _ in range(2))
    lengths = [recording.times.shape for recording in recordings]
    states = np.arange(model.cycle_length_)
    for paths in (model.path_, one):
        shapes = [np.shape(path) for path in paths]
        require(shapes == lengths, f"paths of shapes {lengths}", shapes, "give a state a frame")
        seen = np.concatenate(list(paths))
        expected = f"states 0 to {model.cycle_length_ - 1}"
        outside = sorted(set(seen.tolist()) - set(states.tolist()))
        require(not outside, expected, outside[:5], "set cycle_length_ to the number of states")
    for path, again in zip(one, two, strict=True):
        require_equal(path, again, "the same path when asked again", "let align change nothing")


def blends_frame_by_frame(subject: Subject) -> None:
    """Check that a blend is its styles mixed, frame by frame."""
    model = subject.fit_model(COMPLETE, n_styles=_N_STYLES)
    weights = np.random.default_rng(0).dirichlet(np.ones(_N_STYLES), size=30)
    pure = [model.blend(np.tile(one, (30, 1))) for one in np.eye(_N_STYLES)]
    mixed = sum(share[:, None] * style for share, style in zip(weights.T, pure, strict=True))
    gap = float(np.abs(model.blend(weights) - mixed).max())
    advice = "weigh the styles' mean poses at the same state"
    require(gap < _CLOSE, "the weighted mean of the styles", f"a difference of {gap:.2g}", advice)
