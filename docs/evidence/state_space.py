"""Experiments on `lds` and `lgssm`, reported in `docs/mathematics/state-space.md`.

::

    python docs/evidence/state_space.py states    # how well `lds` fills a walker left out
    python docs/evidence/state_space.py clusters  # whether `lgssm` groups by style or by person

For the first, each training walker of `missing-frames` takes the place of the test in turn: its
first 50 frames with the task's twelve windows. The task's own test recordings are not used.
"""

from __future__ import annotations

import sys
import time
import warnings
from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np

from mocapbench import benchmark as bench
from mocapbench.baselines import LDS, LGSSM
from mocapbench.benchmark.tasks.hlm_recordings import CMU, read_features
from mocapbench.benchmark.tasks.missing_frames import (
    FIRST_HIDDEN,
    GROUPS,
    N_HIDDEN,
    N_TEST_FRAMES,
    N_WINDOWS,
    TRAINING,
)
from mocapbench.datasets import Recording, gpdm_features, one_based_frames

N_STARTS = 12
STATES = (3, 5, 8, 10, 12, 15, 18, 20, 25)


def errors(walks: Sequence[Recording], n_states: int, tol: float) -> list[float]:
    """Return the mean error norm per frame for each walk when it is left out."""
    found = []
    for test in walks:
        model = LDS(n_states, max_iter=100, tol=tol)
        model.fit([walk for walk in walks if walk is not test])
        short = test.frames(np.arange(N_TEST_FRAMES))
        starts = range(FIRST_HIDDEN, FIRST_HIDDEN + N_WINDOWS)
        norms = [_norm(model, short, np.arange(first, first + N_HIDDEN)) for first in starts]
        found.append(float(np.mean(norms)))
    return found


def _norm(model: LDS, test: Recording, hidden: np.typing.NDArray[np.intp]) -> float:
    mask = np.zeros(test.values.shape, dtype=bool)
    mask[hidden] = True
    (prediction,) = model.impute([test.hide(mask)])
    return float(np.linalg.norm((prediction.mean - test.values)[hidden], axis=1).mean())


def states() -> None:
    """Print the errors by number of states, and the seconds that a fit of all walkers takes."""
    warnings.simplefilter("ignore")
    archive = bench.archive_at()
    walks = [
        gpdm_features(one_based_frames(archive.recording(uri), *TRAINING[uri]))
        for uri in GROUPS["three-walkers"]
    ]
    for n_states in STATES:
        for tol in (1e-3, 1e-12):
            left_out = errors(walks, n_states, tol)
            began = time.process_time()
            model = LDS(n_states, max_iter=100, tol=tol).fit(walks)
            seconds = time.process_time() - began
            row = " ".join(f"{error:6.1f}" for error in left_out)
            print(
                f"{n_states:3} states {model.n_iterations_:4} iterations {row}   "
                f"mean {np.mean(left_out):5.1f}   {seconds:.2f} s"
            )


def clusters() -> None:
    """Print the purity of eight clusters, for styles and for subjects, by start."""
    recordings = list(read_features(CMU, bench.archive_at()).values())
    subjects = [uri.partition("_")[0] for uri in CMU]
    for start in range(N_STARTS):
        labels = LGSSM(8, n_restarts=1, random_state=start).fit(recordings).labels_
        styles, people = (_purity(labels, kinds) for kinds in (CMU.values(), subjects))
        print(f"start {start:2}   styles {styles:.2f}   subjects {people:.2f}")


def _purity(labels: np.typing.NDArray[np.intp], kinds: Iterable[str]) -> float:
    groups: dict[int, Counter[str]] = {}
    for label, kind in zip(labels.tolist(), kinds, strict=True):
        groups.setdefault(label, Counter())[kind] += 1
    return sum(max(group.values()) for group in groups.values()) / len(labels)


if __name__ == "__main__":
    {"states": states, "clusters": clusters}[sys.argv[1]]()
