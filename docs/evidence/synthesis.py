"""Why samples correlate less with real motion than in the thesis: see `docs/results/thesis.md`.

The thesis is J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion
Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017.

::

    python docs/evidence/synthesis.py frames               # the MLC of the mean of two walks
    python docs/evidence/synthesis.py variants [MAX_ITER]  # other kernels, and other units

Recordings are read from the folder in the environment variable MOCAPBENCH_DATA.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np
import pandas as pd
from sklearn.preprocessing import minmax_scale

from mocapbench.baselines.moa import MOA
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.benchmark import METRICS
from mocapbench.benchmark.tasks.mocap_synthesis import N_SAMPLES
from mocapbench.benchmark.tasks.thesis_recordings import (
    EVALUATION,
    KICKS,
    TRAINING,
    WALKS,
    Window,
    read_excerpt,
)
from mocapbench.datasets import Recording, named_folders, open_archive
from mocapbench.metrics import Synthesis

REFERENCES = {name: uri for name, uri in WALKS.items() if name != "38(2)"}
TWO_WALKS = ("cmu:02_01", "cmu:02_02")
PAIRS = {
    "two walks": (TWO_WALKS, TRAINING, REFERENCES),
    "walk and stride": (("cmu:02_01", "cmu:08_07"), TRAINING, REFERENCES),
    "short kicks": (("cmu:10_05", "cmu:10_06"), EVALUATION, KICKS),
}
FRAMES: Sequence[Window] = ((0, 298), (0, 343), (20, 298), (20, 343))


def scaled(recording: Recording) -> Recording:
    """Return a recording with every channel mapped to [0, 1]."""
    return replace(recording, values=minmax_scale(recording.values))


UNITS: Mapping[str, Callable[[Recording], Recording]] = {
    "recorded": lambda recording: recording,
    "ranges": scaled,
}
MODELS: Mapping[str, type[MOHGP] | type[MOA]] = {"mohgp-3": MOHGP, "moa-3": MOA}


def excerpts(uris: Sequence[str], windows: Mapping[str, Window]) -> list[Recording]:
    """Return 90 frames of each recording."""
    archive = open_archive(*named_folders(os.environ["MOCAPBENCH_DATA"]))
    return [read_excerpt(archive, uri, windows) for uri in uris]


def compared_with(uris: Mapping[str, str]) -> dict[str, np.ndarray]:
    """Return the curves (N, D) of each reference."""
    recordings = excerpts(list(uris.values()), EVALUATION)
    return {name: recording.values for name, recording in zip(uris, recordings, strict=True)}


def mlc(samples: np.ndarray, references: Mapping[str, np.ndarray]) -> dict[str, float]:
    """Return the MLC of samples (n, N, D) with each reference."""
    score = METRICS.get("mlc")
    return {
        name: score(Synthesis(samples, curves[None])).value for name, curves in references.items()
    }


def frames() -> Iterator[dict[str, object]]:
    """Yield the MLC of the mean of both walks, and of one with the other, for several windows.

    A window ends with the recording if that is shorter: 2(1) has 343 frames and 2(2) has 298. Each
    is then resampled to 90 frames, so that the mean pairs equal fractions of the walks rather than
    equal times.
    """
    references = compared_with(REFERENCES)
    for window in FRAMES:
        one, other = (r.values for r in excerpts(TWO_WALKS, dict.fromkeys(TRAINING, window)))
        mean = 0.5 * (one + other)
        yield {
            "frames": window,
            **mlc(one[None], {"each other": other}),
            **mlc(mean[None], references),
        }


def variants(max_iter: int) -> Iterator[dict[str, object]]:
    """Yield the scores of samples under other kernels and in other units.

    Log-likelihoods are comparable within the same units only.
    """
    for pair, (uris, windows, references) in PAIRS.items():
        recorded, compared = excerpts(uris, windows), compared_with(references)
        for kernel, unit in product(("matern32", "matern52", "rbf"), UNITS):
            train = [UNITS[unit](recording) for recording in recorded]
            for label, model in MODELS.items():
                fitted = model(n_components=3, kernel=kernel, max_iter=max_iter).fit(train)
                row = {"trained on": pair, "kernel": kernel, "units": unit, "model": label}
                yield {
                    **row,
                    "log L": fitted.log_likelihood_,
                    **_measures(fitted, train, compared),
                }


def _measures(
    fitted: MOHGP | MOA, train: Sequence[Recording], references: Mapping[str, np.ndarray]
) -> dict[str, float]:
    """Return the variance of samples in time over half that of the recordings' difference.

    It is the median over channels. The MLC of the samples with each reference is returned too.
    """
    times = train[0].times
    samples, (trend, _) = fitted.sample(times, N_SAMPLES, 0), fitted.trend(times)
    drawn = (samples - trend).var(axis=1).mean(axis=0)
    differed = 0.5 * (train[0].values - train[1].values).var(axis=0)
    return {"drawn / differed": float(np.median(drawn / differed)), **mlc(samples, references)}


def main(table: str, max_iter: str = "200") -> None:
    """Print one of the tables."""
    tables: Mapping[str, Callable[[], Iterator[dict[str, object]]]] = {
        "frames": frames,
        "variants": partial(variants, int(max_iter)),
    }
    print(pd.DataFrame(tables[table]()).round(3).to_string(index=False))


if __name__ == "__main__":
    main(*sys.argv[1:])
