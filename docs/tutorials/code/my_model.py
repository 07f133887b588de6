"""A model for `mocapbench run --plugin my_model.py`."""

import numpy as np

from mocapbench.baselines import Inductive, Interpolator, Prediction


class LeastJerk(Interpolator, Inductive):
    """Fill each channel with the course of least jerk."""

    def fit(self, recordings):
        return self  # there is nothing to learn

    def impute(self, recordings):
        return [
            Prediction.around(
                recording,
                np.apply_along_axis(least_jerk, 0, recording.values),
            )
            for recording in recordings
        ]


def least_jerk(course):
    """Return the values (N,) of one channel with its NaN filled in."""
    hidden = np.isnan(course)
    jerk = np.diff(
        np.eye(len(course)), 3, axis=0
    )  # (N - 3, N) takes third differences
    filled = course.copy()
    filled[hidden] = np.linalg.lstsq(
        jerk[:, hidden], -jerk[:, ~hidden] @ course[~hidden]
    )[0]
    return filled


MODELS = {"least-jerk": LeastJerk}
