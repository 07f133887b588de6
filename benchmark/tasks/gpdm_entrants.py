"""The GPDM family as tasks with missing frames enter it: each learning, with stated starts."""

from __future__ import annotations

from mocapbench.benchmark.tasks.base import Entrant

__all__ = ["GPDM_STARTS", "NOT_QUICK", "POSE_VITERBI", "REPRODUCTIONS", "SLOW", "WITH_BEST_START"]

_TWO_STAGE = {"learning": "two-stage", "n_samples": 25}

POSE_VITERBI = (
    Entrant("pose-viterbi", "pose-viterbi"),
    Entrant("pose-viterbi-no-offset", "pose-viterbi", {"subject_offset": 0.0}),
)
REPRODUCTIONS = (
    Entrant("gplvm-linear", "gplvm", {"start": "linear"}),
    Entrant("gpdm-map-linear", "gpdm", {"learning": "map", "start": "linear"}),
    Entrant("gpdm-balanced-mean", "gpdm", {"learning": "balanced", "start": "mean-prediction"}),
    Entrant("gpdm-fixed-alpha-window", "gpdm", {"learning": "fixed-alpha", "start": "window"}),
    Entrant("gpdm-two-stage-window", "gpdm", {**_TWO_STAGE, "start": "window"}),
)
"""Each learning with the start whose errors are nearest to the published ones."""

WITH_BEST_START = (
    Entrant("gplvm-window", "gplvm", {"start": "window"}),
    Entrant("gpdm-map-viterbi", "gpdm", {"learning": "map", "start": "viterbi"}),
    Entrant("gpdm-balanced-viterbi", "gpdm", {"learning": "balanced", "start": "viterbi"}),
    Entrant("gpdm-fixed-alpha-viterbi", "gpdm", {"learning": "fixed-alpha", "start": "viterbi"}),
    Entrant("gpdm-two-stage-viterbi", "gpdm", {**_TWO_STAGE, "start": "viterbi"}),
)
"""Each learning with the best of its starts."""

GPDM_STARTS = (
    *REPRODUCTIONS,
    *WITH_BEST_START,
    Entrant("gpdm-balanced-6d-viterbi", "gpdm", {"n_latent": 6, "start": "viterbi"}),
    Entrant(
        "gpdm-balanced-6d-viterbi-offset",
        "gpdm",
        {"n_latent": 6, "start": "viterbi", "subject_offset": 1.0},
    ),
)

SLOW = ("gpdm-two-stage-window", "gpdm-two-stage-viterbi")
"""Entrants that learn for minutes."""

NOT_QUICK = (
    *SLOW,
    "gplvm-linear",
    "gplvm-window",
    "gpdm-map-linear",
    "gpdm-map-viterbi",
    "gpdm-balanced-mean",
    "gpdm-fixed-alpha-window",
    "gpdm-fixed-alpha-viterbi",
    "gpdm-balanced-6d-viterbi",
)
"""Entrants that the default profile has no time for."""
