"""Tables of docs/results/positions.md: ``python docs/evidence/degrees_and_centimetres.py RUN``.

RUN is a run directory, such as of ``mocapbench run --profile quick``. Scores are means over folds
and then over the cases on recordings.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pandas as pd

from mocapbench import benchmark as bench

TASKS = {
    "missing-frames": ["rms_per_frame", "mpjpe"],
    "golf-swings": ["rms_per_frame", "mpjpe"],
    "walking-interpolation": ["smse_pooled", "mpjpe"],
    "upper-body-missing": ["mse", "mpjpe"],
    "subject-35-missing": ["cumulative_scaled_error", "rms_angle"],
}


def means(scores: pd.DataFrame, task: str) -> pd.DataFrame:
    """Return a row an entrant, a column a metric, of the cases on recordings."""
    of_task = scores[(scores["task"] == task) & ~scores["case"].str.startswith("synthetic")]
    by_case = of_task.groupby(["label", "metric", "case"])["value"].mean()
    return by_case.groupby(["label", "metric"]).mean().unstack("metric")


def main(run: Path) -> None:
    """Print a Markdown table for each task, the best by the first metric first."""
    scores = bench.score_table(bench.RunDirectory(run).planned())
    for task, metrics in TASKS.items():
        table = means(scores, task)[metrics].sort_values(metrics[0])
        ranks = table.rank().astype(int)
        print(f"\n`{task}`\n\n| entrant | {' | '.join(f'`{m}`' for m in metrics)} |")
        print("|---" * (len(metrics) + 1) + "|")
        for label, row in table.iterrows():
            rank = ranks.loc[str(label)]
            cells = (f"{row[m]:.3g} ({rank[m]})" for m in metrics)
            print(f"| `{label}` | {' | '.join(cells)} |")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
