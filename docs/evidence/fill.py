"""How good the model is that `mocapbench fill --model best` chooses.

Gaps are cut into recordings of the CMU database, of different people and motions, and filled by
every model that was compared. Errors are root mean squared errors over the hidden angles, in
degrees, and over the hidden coordinates of the root, in cm. The score of a fill is the mean of the
two, each relative to that of `hold`. The choice, of a model for each kind of gap, is compared with
the best model of the file, chosen by the truth, and with linear interpolation. Takes half an hour
on two cores:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/fill.py
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.filling.costs import predict_calibrated_seconds
from mocapbench.benchmark.filling.filled_recording import FilledRecording, fill
from mocapbench.benchmark.filling.gaps import find_gaps
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import AcclaimFormat, Mask, Recording, unwrap_angles

Array = NDArray[np.float64]

RECORDINGS = {
    "02_01": "walk",
    "02_03": "run",
    "02_04": "jump",
    "02_06": "bend over, scoop up",
    "02_09": "swordplay",
    "02_10": "wash oneself",
    "07_01": "walk",
    "09_01": "run",
    "10_02": "kick a ball",
    "11_01": "kick a ball",
    "16_03": "high jump",
    "16_22": "walk, veer",
    "35_01": "walk",
    "39_01": "climb",
    "64_01": "golf swing",
    "64_20": "golf, place a ball",
}
LONGEST = 1500
"""Frames."""
EFFORT = "normal"
BESIDE = ("hold", "linear")
"""Models that scores are relative to."""
N_SPLITS = 100
CENTIMETRES = 2.54 / 0.45
"""In the unit of length of the database."""
LIMBS = (("lfemur", "ltibia", "lfoot", "ltoes"), ("rhumerus", "rradius", "rwrist", "rhand"))


class Cut(NamedTuple):
    """How gaps are cut: in which channels, how many, and from how many to how many frames."""

    groups: tuple[tuple[str, ...], ...]
    n_gaps: int
    shortest: int
    longest: int


class Result(NamedTuple):
    """Errors of the choice and of each model in the file itself, and how the file was filled."""

    squares: dict[str, Array]
    """Sums of squared errors in each gap (n, 2): of angles, in deg²; of position, in cm².

    Those of the choice are called ``best``.
    """
    counts: Array
    """The number of angles and of coordinates in each gap (n, 2)."""
    filled: FilledRecording

    def errors(self, gaps: NDArray[np.intp] | slice = slice(None)) -> dict[str, Array]:
        """Return the root mean squared errors (2,) of each model over some gaps.

        NaN where they hide no angle, or no coordinate.
        """
        counts = self.counts[gaps].sum(axis=0)
        counts[counts == 0.0] = np.nan
        return {
            model: np.sqrt(squares[gaps].sum(axis=0) / counts)
            for model, squares in self.squares.items()
        }

    def scores(self, gaps: NDArray[np.intp] | slice = slice(None)) -> dict[str, float]:
        """Return the mean of a model's two errors over some gaps, relative to those of `hold`."""
        errors = self.errors(gaps)
        return {model: float(np.nanmean(of / errors["hold"])) for model, of in errors.items()}


def cuts(recording: Recording) -> dict[str, Cut]:
    """Return three ways to lose entries: whole frames, a limb, single segments."""
    segments = tuple({name.split(".")[0]: () for name in recording.channels})
    return {
        "frames": Cut((segments,), 4, 8, 30),
        "limbs": Cut(LIMBS, 8, 12, 60),
        "segments": Cut(tuple((segment,) for segment in segments), 16, 8, 80),
    }


def mask_of(recording: Recording, cut: Cut, rng: np.random.Generator) -> Mask:
    """Return a mask with gaps at random positions, none of which touch."""
    owners = np.array([name.split(".")[0] for name in recording.channels])
    hidden, n_frames = np.zeros(recording.values.shape, dtype=bool), len(recording.times)
    for _ in range(cut.n_gaps):
        length = int(rng.integers(cut.shortest, min(cut.longest, n_frames // 8) + 1))
        channels = np.isin(owners, cut.groups[rng.integers(len(cut.groups))])
        for start in rng.integers(3, n_frames - length - 3, size=50):
            beside = hidden[start - 3 : start + length + 3]
            if not beside[:, channels].any():
                hidden[start : start + length, channels] = True
                break
    return hidden


def problems(
    folder: Path, names: Iterable[str] = RECORDINGS
) -> Iterator[tuple[str, str, Recording, Mask]]:
    """Yield each recording with each kind of gaps."""
    for name in names:
        whole = AcclaimFormat().read(folder / "subjects" / name[:2] / f"{name}.amc")
        recording = whole.frames(np.arange(min(len(whole.times), LONGEST)))
        for kind, cut in cuts(recording).items():
            rng = np.random.default_rng([int(name[:2]), int(name[3:]), len(kind)])
            yield name, kind, recording, mask_of(recording, cut, rng)


def evaluate(recording: Recording, hidden: Mask, workers: Workers, effort: str) -> Result:
    """Return how the choice and every model that was compared fill the gaps."""
    named = np.full(int(hidden.sum()), BEST)
    request = FillRequest(unwrap_angles(recording.hide(hidden)), hidden, named)
    filled = fill(request, workers, effort, lambda *_: None)
    assert filled.choice is not None
    kept = workers.keep(request.problem)
    futures = {
        workers.submit(model, kept, predict_calibrated_seconds(model, request.problem)): model
        for model in dict.fromkeys((*(one.model for one in filled.choice.contenders), *BESIDE))
    }
    squares = {BEST: by_gap(recording, hidden, filled.prediction.mean)} | {
        futures[future]: by_gap(recording, hidden, attempt.prediction.mean)
        for future, attempt in workers.collect(futures.keys()).items()
        if attempt.prediction is not None
    }
    angles = np.array(recording.units) == "deg"
    counts = [
        [len(gap) * kind[list(gap.channels)].sum() for kind in (angles, ~angles)]
        for gap in find_gaps(hidden)
    ]
    return Result(squares, np.array(counts, dtype=float), filled)


def by_gap(recording: Recording, hidden: Mask, mean: Array) -> Array:
    """Return the sums of squared errors of angles and position in each gap (n, 2).

    Multiples of 360° are no error.
    """
    angles = np.array(recording.units) == "deg"
    off = np.zeros(hidden.shape)
    off[hidden] = mean - recording.values[hidden]
    off[:, angles] -= 360.0 * np.round(off[:, angles] / 360.0)
    off[:, ~angles] *= CENTIMETRES
    within = [(off[gap.start : gap.stop], list(gap.channels)) for gap in find_gaps(hidden)]
    return np.array(
        [
            [(block[:, channels][:, kind[channels]] ** 2).sum() for kind in (angles, ~angles)]
            for block, channels in within
        ]
    )


def find_best(scores: dict[str, float]) -> str:
    """Return the model with the least score."""
    return min((model for model in scores if model != BEST), key=scores.__getitem__)


def by_halves(result: Result, rng: np.random.Generator) -> list[float]:
    """Return the ratios to the best of choices that know the truth, but of the other gaps only.

    In each, the model with the least error in a random half of the gaps fills the other half.
    """
    ratios, n_gaps = [], len(result.counts)
    for _ in range(N_SPLITS):
        known, filled = np.array_split(rng.permutation(n_gaps), 2)
        before, after = result.scores(known), result.scores(filled)
        ratios.append(after[find_best(before)] / after[find_best(after)])
    return ratios


def row(what: Sequence[str], result: Result, best: str) -> str:
    """Return a row of the table: the errors of the choice, of the best model, and of `linear`."""
    errors = result.errors()
    pairs = {
        model: " | ".join("" if np.isnan(error) else f"{error:.2f}" for error in errors[model])
        for model in (BEST, best, "linear")
    }
    used = ", ".join(result.filled.used)
    return f"| {' | '.join((*what, used, pairs[BEST], best, pairs[best], pairs['linear']))} |"


def report(what: str, to: str, ratios: Array, bar: float) -> None:
    """Print how large ratios are, without those that are not defined."""
    given = ratios[np.isfinite(ratios)]
    print(
        f"\n{what} relative to {to}: mean {given.mean():.3f}, median {np.median(given):.3f}, "
        f"largest {given.max():.2f}; above {bar} in {(given > bar).sum()} of {len(given)}."
    )


def main() -> None:
    """Print a row per recording and kind of gaps, and how often the bars are missed."""
    rows, halves = [], []
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    print("| recording | gaps | choice | ° | cm | best model | ° | cm | linear, ° | cm |")
    print(f"|{'---|' * 10}")
    with Workers(os.cpu_count() or 1) as workers:
        for name, kind, recording, hidden in problems(folder):
            result = evaluate(recording, hidden, workers, EFFORT)
            scores, errors = result.scores(), result.errors()
            halves.append(by_halves(result, np.random.default_rng(0)))
            best = find_best(scores)
            print(row((f"{name} {RECORDINGS[name]}", kind), result, best), flush=True)
            relative = [scores[BEST] / scores[other] for other in (best, "linear")]
            rows.append([*relative, *(errors[BEST] / errors["linear"])])
    to_best, to_linear, angles, position = np.array(rows).T
    report("Scores", "the best", to_best, 1.10)
    report("Scores", "linear", to_linear, 1.05)
    report("Angles", "linear", angles, 1.05)
    report("Position", "linear", position, 1.05)
    ratio = np.concatenate(halves)
    print(
        f"\nA model chosen by the truth in half of the gaps, relative to the best in the others: "
        f"mean {ratio.mean():.3f}, above 1.1 in {(ratio > 1.1).mean():.0%}."
    )


if __name__ == "__main__":
    main()
