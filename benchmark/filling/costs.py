"""How much work models take, predicted from the size of a problem."""

from __future__ import annotations

from mocapbench.benchmark.filling.gap_problem import GapProblem

__all__ = ["predict_calibrated_seconds", "predict_seconds"]

_SECONDS = {
    **dict.fromkeys(("linear", "hold", "makima", "pchip", "cubic-spline"), 0.02),
    **{"marker-kriging": 0.5, "rigid-body": 0.1, "channel-kriging": 0.4, "pose-kriging": 0.5},
    **{"lds": 1.0, "knn": 0.3, "pca-regression": 0.1, "trivial": 0.01, "low-rank": 0.4},
}


def predict_seconds(name: str, problem: GapProblem) -> float:
    """Return the seconds of a core that a model takes to fill a problem."""
    size = problem.n_frames * len(problem.given.channels)
    return _SECONDS.get(name, 20.0) * (0.2 + size / 72_000)


def predict_calibrated_seconds(name: str, problem: GapProblem) -> float:
    """Return the seconds of a core that a model takes with its intervals calibrated."""
    return 3 * predict_seconds(name, problem)
