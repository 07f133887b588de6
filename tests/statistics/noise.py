"""Variation over folds: `python noise.py ONE.csv LABEL OTHER.csv LABEL [METRIC]`.

For one entrant in each of two exports (`mocapbench export`), prints by case the standard deviation
over folds of the log values (s, the variation between folds) and of the log ratio of the two (u,
the variation that pairing does not cancel).
"""

from __future__ import annotations

import sys

import numpy as np
import pandas as pd


def log_values(path: str, label: str, metric: str) -> pd.Series[float]:
    """Return the log values of one entrant, by case and fold."""
    scores = pd.read_csv(path)
    chosen = scores[(scores["label"] == label) & (scores["metric"] == metric)]
    return np.log(chosen.set_index(["case", "fold"])["value"])


def scatter(one: pd.Series[float], other: pd.Series[float]) -> pd.DataFrame:
    """Return s and u by case."""
    spread = {"s": one.groupby("case").std(), "u": (other - one).groupby("case").std()}
    return pd.DataFrame(spread)


if __name__ == "__main__":
    one_path, one_label, other_path, other_label, *metric = sys.argv[1:]
    name = metric[0] if metric else "mse"
    found = scatter(
        log_values(one_path, one_label, name), log_values(other_path, other_label, name)
    )
    print(found.round(3).to_string())
    print("median", found.median().round(3).to_dict())
