"""Experiments on `cyclic-alignment`, reported in `docs/frontier/aligned.md`.

::

    python docs/evidence/aligned.py styles [RESTARTS]  # purity by start, before and after EM
    python docs/evidence/aligned.py bodies             # upper bodies of subjects 08 and 35
    python docs/evidence/aligned.py walks              # the task's eleven walks, five seeds

`bodies` is what choices were made by. Subject 07, whose walks the task scores, takes no part: each
of eight walks of subjects 08 and 35 is left out in turn of 28 recordings of 08, 09 and 35.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence

import numpy as np

from mocapbench import benchmark as bench
from mocapbench.baselines import CyclicAlignment
from mocapbench.baselines.alignment.fitting import restarts, run, split
from mocapbench.benchmark.tasks.hlm_recordings import CMU
from mocapbench.datasets import Recording

VISIBLE = ("root", "tibia", "foot", "toes")
LEFT_OUT = ("08_01", "08_03", "08_06", "08_09", "35_01", "35_03", "35_05", "35_07")


def purity(labels: np.typing.NDArray[np.intp]) -> float:
    """Return the share of recordings whose label is the commonest of their cluster."""
    truth = np.array(list(CMU.styles.values()))
    tops = [np.unique(truth[labels == c], return_counts=True)[1].max() for c in set(labels)]
    return float(np.sum(tops)) / len(truth)


def styles(n_restarts: int = 5) -> None:
    """Print the purity of similar and of random groups, as they start and after EM."""
    recordings = list(CMU.read(bench.archive_at(None)).values())
    for n_styles in range(2, 9):
        rows = []
        for seed in range(n_restarts):
            model = CyclicAlignment(
                n_styles=n_styles,
                n_restarts=1,
                max_iter=1,
                grouping="similar",
                random_state=seed,
            ).fit(recordings)
            rng = np.random.default_rng(seed)
            one = model.settings_.__class__(**{**vars(model.settings_), "n_styles": 1})
            (common,) = restarts(model.sequences_, one, n_restarts=1, max_iter=1, rng=rng)
            mixed = np.eye(n_styles)[rng.permutation(len(recordings)) % n_styles]
            ends = [
                run(state, model.sequences_, model.settings_, 40).state
                for state in (model.state_, split(common.state, mixed))
            ]
            rows.append(
                [purity(model.labels_), *(purity(end.labels.argmax(axis=1)) for end in ends)]
            )
        print(n_styles, "start, similar, random:", *np.round(np.mean(rows, axis=0), 3), flush=True)


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
    recordings = CMU.read(bench.archive_at(None))
    others = {name: r for name, r in recordings.items() if not name.startswith("cmu:07")}
    _left_out(others, [f"cmu:{trial}" for trial in LEFT_OUT], 0)


def walks() -> None:
    """Print the errors on the task's walks."""
    recordings = CMU.read(bench.archive_at(None))
    for seed in range(5):
        _left_out(recordings, [n for n in recordings if n.startswith("cmu:07")], seed)


if __name__ == "__main__":
    command, *numbers = sys.argv[1:]
    {"styles": styles, "bodies": bodies, "walks": walks}[command](*map(int, numbers))
