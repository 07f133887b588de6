"""How good the models are that `mocapbench fill` chooses for files of markers.

    python docs/evidence/marker_files.py FILE [FILE ...]

Hides more gaps of single markers in each file where they are visible: ten, of a twentieth of a
second to a second. Gaps at the ends of a file stay open. `best` fills the others, and so does each
model that it compared. Prints the root mean squared distances, in the file's unit, of the choice
and of the model with the least, and the ratio of the two. Of an Acclaim file, the positions of
joints take the place of markers. Only the first 1500 frames count. Takes about a minute a file.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import mocapbench
from mocapbench.benchmark.filling.costs import predict_seconds
from mocapbench.benchmark.filling.filled_recording import fill
from mocapbench.benchmark.filling.gaps import mask_ends
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import AcclaimFormat, Mask, Recording, joint_trajectories

LONGEST = 1500
N_GAPS = 10
BAR = 1.1


def read_markers(path: Path) -> Recording:
    """Return the coordinates of the markers, or joints, that a file has."""
    if path.suffix != ".amc":
        recording = mocapbench.read(path)
        lengths = [
            name
            for name, unit in zip(recording.channels, recording.units, strict=True)
            if unit in ("mm", "cm", "m", "")
        ]
        recording = recording.select(lengths)
    else:
        skeleton = AcclaimFormat().skeleton(path)
        assert skeleton is not None
        recording = joint_trajectories(skeleton, AcclaimFormat().read(path))
    return recording.frames(np.arange(min(len(recording.times), LONGEST)))


def hide_gaps(recording: Recording, rng: np.random.Generator) -> Mask:
    """Return a mask of gaps of single markers, where these are visible beside the gap."""
    n_frames, n_channels = recording.values.shape
    rate = (n_frames - 1) / (recording.times[-1] - recording.times[0])
    hidden = np.zeros(recording.values.shape, dtype=bool)
    made = 0
    for _ in range(1000):
        longest = max(min(rate, n_frames / 8), 4.0)
        length = int(rng.integers(max(int(rate / 20), 2), int(longest) + 1))
        start = int(rng.integers(1, n_frames - length - 1))
        marker = 3 * int(rng.integers(n_channels // 3))
        beside = slice(start - 1, start + length + 1), slice(marker, marker + 3)
        if recording.visible[beside].all() and not hidden[beside].any():
            hidden[start : start + length, marker : marker + 3] = True
            made += 1
        if made == N_GAPS:
            break
    return hidden


def measure_errors(
    recording: Recording, hidden: Mask, workers: Workers
) -> Iterator[tuple[str, float, str]]:
    """Yield `best` and each model that it compared, with its error; the first with its choice."""
    given = recording.hide(hidden)
    target = ~given.visible & ~mask_ends(given.visible)
    request = FillRequest(given, target, np.full(int(target.sum()), BEST))
    filled = fill(request, workers, "normal", lambda *_: None)
    where = hidden[target]
    truth = recording.values[hidden]

    def measure(mean: NDArray[np.float64]) -> float:
        return float(np.sqrt(3.0 * ((mean[where] - truth) ** 2).mean()))

    yield BEST, measure(filled.prediction.mean), ", ".join(filled.used)
    assert filled.choice is not None
    kept = workers.keep(request.problem)
    futures = {
        workers.submit(
            one.model, kept, predict_seconds(one.model, request.problem), "impute_uncalibrated"
        ): one.model
        for one in filled.choice.contenders
    }
    for future, attempt in workers.collect(futures.keys()).items():
        if attempt.prediction is not None:
            yield futures[future], measure(attempt.prediction.mean), ""


def main(paths: list[Path]) -> None:
    """Print a row per file, and in how many the choice is as good as the best model."""
    print("| file | chosen | error | best by name | error | ratio |")
    print(f"|{'---|' * 6}")
    ratios = []
    with Workers(os.cpu_count() or 1) as workers:
        for path in paths:
            recording = read_markers(path)
            digest = int(sha256(path.read_bytes()).hexdigest()[:8], 16)
            hidden = hide_gaps(recording, np.random.default_rng(digest))
            (_, chosen, used), *others = measure_errors(recording, hidden, workers)
            name, least, _ = min(others, key=lambda each: each[1])
            ratios.append(chosen / least)
            print(
                f"| {path.name} | {used} | {chosen:.3g} | {name} | {least:.3g} "
                f"| {ratios[-1]:.2f} |",
                flush=True,
            )
    within = sum(ratio <= BAR for ratio in ratios)
    print(f"\nWithin {BAR} of the best: {within} of {len(ratios)}.")


if __name__ == "__main__":
    main([Path(argument) for argument in sys.argv[1:]])
