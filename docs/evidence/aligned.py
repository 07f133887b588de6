"""Experiments on `cyclic-alignment`, reported in `docs/results/styles.md`.

::

    python docs/evidence/aligned.py tempo [RESTARTS]  # purity by shape, and by shape and tempo
    python docs/evidence/aligned.py bodies            # upper bodies of subjects 08 and 35
    python docs/evidence/aligned.py walks             # the task's eleven walks, five seeds

`tempo` does so for the task's recordings, and for 31 others, of subjects 02, 16 and 35, by which
the weight of the tempo was judged. `bodies` is what other choices were made by. Subject 07, whose
walks the task scores, takes no part: each
of eight walks of subjects 08 and 35 is left out in turn of 28 recordings of 08, 09 and 35.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence

import numpy as np

from mocapbench import benchmark as bench
from mocapbench.baselines import CyclicAlignment
from mocapbench.baselines.alignment.cycle_start import best_paths, prototypes
from mocapbench.baselines.alignment.restarts import copy_style, run_em
from mocapbench.baselines.common.prototypes import group_rows, of_unit_variance, tempi
from mocapbench.benchmark.tasks.hlm_recordings import CMU, Styles, read_features
from mocapbench.datasets import Recording

VISIBLE = ("root", "tibia", "foot", "toes")
LEFT_OUT = ("08_01", "08_03", "08_06", "08_09", "35_01", "35_03", "35_05", "35_07")


# After the database's index of motions.
OTHERS = {
    f"cmu:{subject}_{trial:02}": style
    for subject, style, trials in (
        ("02", "walk", (1, 2)),
        ("02", "run", (3,)),
        ("16", "walk", (15, 16, 21, 22, 31, 32, 47, 58)),
        ("16", "slow walk", (33, 34)),
        ("16", "run", (35, 36, 45, 46)),
        ("35", "walk", (15, 16, *range(28, 35))),
        ("35", "run", (17, 18, 20, 21, 22)),
    )
    for trial in trials
}


def purity(labels: np.typing.NDArray[np.intp], styles: Styles = CMU) -> float:
    """Return the share of recordings whose label is the commonest of their cluster."""
    truth = np.array([style for _, style in sorted(styles.items())])
    tops = [np.unique(truth[labels == c], return_counts=True)[1].max() for c in set(labels)]
    return float(np.sum(tops)) / len(truth)


def tempo(n_restarts: int = 5) -> None:
    """Print the purity of groups by shape, and by shape and tempo, as they start and after EM."""
    for name, styles in (("others", OTHERS), ("the task's", CMU)):
        recordings = list(read_features(styles, bench.archive_at()).values())
        for n_styles in range(2, 9):
            rows = [_by_tempo(recordings, styles, n_styles, seed) for seed in range(n_restarts)]
            print(name, n_styles, "shape, and tempo:", *np.mean(rows, axis=0).round(3))


def _by_tempo(
    recordings: Sequence[Recording], styles: Styles, n_styles: int, seed: int
) -> list[float]:
    rng = np.random.default_rng(seed)
    model = CyclicAlignment(n_styles=1, n_restarts=1, max_iter=1, random_state=rng).fit(recordings)
    paths, trace = best_paths(model.state_, model.sequences_), model.state_.cycles.mean[:, 0]
    shapes = prototypes(paths, model.sequences_, trace).reshape(len(recordings), -1)
    features = of_unit_variance(shapes)
    both = np.column_stack([features, tempi(paths, len(trace))])
    found = []
    for chosen in (features, both):
        labels = group_rows(chosen, n_styles, 10, rng)
        state = copy_style(model.state_, np.eye(n_styles)[labels])
        ended = run_em(state, model.sequences_, model.hyper_, 40).state.labels.argmax(axis=1)
        found += [purity(labels, styles), purity(ended, styles)]
    return found


def _error(test: Recording, others: Sequence[Recording], seed: int) -> list[float]:
    """Return the squared error (deg²) of one, two, … runs averaged, and seconds of both steps."""
    segments = [channel.partition(".")[0] for channel in test.channels]
    hidden = [not segment.endswith(VISIBLE) for segment in segments]
    mask = np.outer(np.arange(len(test.times)) >= len(test.times) // 2, hidden)
    began = time.process_time()
    model = CyclicAlignment(random_state=seed).fit(others)
    fitted = time.process_time()
    (prediction,) = model.impute([test.hide(mask)])
    error = float(((prediction.mean - test.values)[mask] ** 2).mean())
    return [error, fitted - began, time.process_time() - fitted]


def _left_out(recordings: dict[str, Recording], names: Sequence[str], seed: int) -> None:
    rows = [
        _error(recordings[name], [r for n, r in recordings.items() if n != name], seed)
        for name in names
    ]
    errors, *seconds = np.array(rows).T
    print(f"seed {seed} mean {errors.mean():.2f}", np.round(errors, 1), np.mean(seconds, axis=1))


def bodies() -> None:
    """Print the errors on walks of subjects 08 and 35, without subject 07."""
    recordings = read_features(CMU, bench.archive_at())
    others = {name: r for name, r in recordings.items() if not name.startswith("cmu:07")}
    _left_out(others, [f"cmu:{trial}" for trial in LEFT_OUT], 0)


def walks() -> None:
    """Print the errors on the task's walks."""
    recordings = read_features(CMU, bench.archive_at())
    for seed in range(5):
        _left_out(recordings, [n for n in recordings if n.startswith("cmu:07")], seed)


if __name__ == "__main__":
    command, *numbers = sys.argv[1:]
    {"tempo": tempo, "bodies": bodies, "walks": walks}[command](*map(int, numbers))
