"""How well `marker-kriging`, other models and the choice of `fill` fill gaps of skin markers.

Markers are fixed to segments of skeletons of the CMU database, three on each of nine, up to 10 cm
from its end, so that where they are is known. Each also wanders on the skin, smoothly within a
quarter of a second, by a standard deviation of 0, 3 or 10 mm in each direction, and is measured
with one of 0.2 mm. Single markers are lost, or all three of a segment. Errors are root mean squared
distances in mm, and of recordings the geometric mean is shown; then the share of coordinates that
the 95 % intervals of `marker-kriging` hold. Nothing was chosen on the second recordings.
Takes 35 minutes on two cores:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/markers.py [EFFORT]
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from mocapbench.baselines import (
    ChannelKriging,
    CubicSplineImputer,
    FrameImputer,
    MakimaImputer,
    MarkerKriging,
    PCARegression,
    PchipImputer,
    Prediction,
    RigidBody,
)
from mocapbench.benchmark.filling.filled_recording import fill
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import (
    AcclaimFormat,
    Mask,
    Recording,
    Segment,
    Skeleton,
    joint_trajectories,
)

Array = NDArray[np.float64]

RECORDINGS = {
    "chosen on": ("02_01", "07_01", "09_01", "12_01", "16_03", "39_01", "64_01", "10_02"),
    "others": (
        *("02_02", "02_05", "07_05", "08_03", "10_05", "11_01"),
        *("16_11", "16_17", "16_32", "35_10", "39_05", "64_20"),
    ),
}
LONGEST = 1000
"""Frames, of 120 a second."""
SIDES = [f"{side}{bone}" for side in "lr" for bone in ("femur", "tibia", "humerus", "radius")]
SEGMENTS = ("thorax", *SIDES)
PER_SEGMENT = 3
WANDERING = (0.0, 3.0, 10.0)
"""Millimetres."""
GAPS = {"single markers": (1, 10), "all of a segment": (PER_SEGMENT, 4)}
"""How many markers are lost together, and how many times."""
MODELS_ALONE: dict[str, FrameImputer] = {
    "marker-kriging": MarkerKriging(),
    "rigid-body": RigidBody(),
    "cubic-spline": CubicSplineImputer(),
    "makima": MakimaImputer(),
    "pchip": PchipImputer(),
    "pca-regression": PCARegression(),
    "channel-kriging": ChannelKriging(),
}


def markers(skeleton: Skeleton, rng: np.random.Generator) -> tuple[Segment, ...]:
    """Return segments that do not move against their parents, whose ends are the markers."""
    offsets = rng.normal(size=(len(SEGMENTS), PER_SEGMENT, 3))
    lengths = rng.uniform(3.0, 10.0, offsets.shape[:2]) / skeleton.centimetres_per_unit
    offsets /= np.linalg.norm(offsets, axis=2, keepdims=True)
    origin = (0.0, 0.0, 0.0)
    return tuple(
        Segment(f"{parent}{n}", parent, (*map(float, way),), float(length), origin, "XYZ", ())
        for parent, ways, of_parent in zip(SEGMENTS, offsets, lengths, strict=True)
        for n, (way, length) in enumerate(zip(ways, of_parent, strict=True))
    )


def recorded(name: str, wandering: float, rng: np.random.Generator) -> Recording:
    """Return the markers of a recording, in millimetres."""
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    path = folder / "subjects" / name[:2] / f"{name}.amc"
    skeleton = AcclaimFormat().skeleton(path)
    assert skeleton is not None
    added = markers(skeleton, rng)
    motion = AcclaimFormat().read(path)
    motion = motion.frames(np.arange(min(len(motion.times), LONGEST)))
    whole = joint_trajectories(replace(skeleton, segments=(*skeleton.segments, *added)), motion)
    skin = whole.select([f"{marker.name}.{axis}" for marker in added for axis in "xyz"])
    on_skin = gaussian_filter1d(rng.normal(size=skin.values.shape), 15, axis=0)
    on_skin *= wandering / on_skin.std(axis=0)
    values = 10 * skin.values + on_skin + rng.normal(0.0, 0.2, skin.values.shape)
    return Recording(name, skin.times, values, skin.channels, ("mm",) * len(skin.channels))


def lost(recording: Recording, together: int, n_gaps: int, rng: np.random.Generator) -> Mask:
    """Return a mask with gaps of a tenth of a second to a second."""
    hidden = np.zeros((len(recording.times), len(SEGMENTS) * PER_SEGMENT // together, together, 3))
    for _ in range(n_gaps):
        start, length = rng.integers(5, len(hidden) - 130), rng.integers(12, 121)
        hidden[start : start + length, rng.integers(hidden.shape[1])] = True
    return np.asarray(hidden.reshape(recording.values.shape), dtype=bool)


def distance(recording: Recording, hidden: Mask, mean: Array) -> float:
    """Return the root mean squared distance of hidden markers from where they are."""
    squares = np.where(hidden, mean - recording.values, 0.0) ** 2
    return float(np.sqrt(3.0 * squares.sum() / hidden.sum()))


def held(recording: Recording, hidden: Mask, prediction: Prediction) -> float:
    """Return the share of hidden entries that 95 % intervals hold."""
    assert prediction.variance is not None
    errors = np.abs(prediction.mean - recording.values)
    return float((errors <= 1.96 * np.sqrt(prediction.variance))[hidden].mean())


def fills(
    recording: Recording, hidden: Mask, workers: Workers, effort: str
) -> Iterator[tuple[str, float, float]]:
    """Yield what fills, its error, and the share that intervals hold, if it has any."""
    given = recording.hide(hidden)
    for name, model in MODELS_ALONE.items():
        (prediction,) = model.fit([given]).impute([given])
        share = np.nan if prediction.variance is None else held(recording, hidden, prediction)
        yield name, distance(recording, hidden, prediction.mean), share
    request = FillRequest(given, hidden, np.full(int(hidden.sum()), BEST))
    filled = fill(request, workers, effort, lambda *_: None)
    yield f"best: {filled.used[0]}", distance(recording, hidden, filled.recording.values), np.nan


def row(names: Sequence[str], seed: int, wandering: float, workers: Workers, effort: str) -> str:
    """Return mean errors, what was chosen for most entries, and what intervals hold."""
    together, n_gaps = list(GAPS.values())[seed]
    errors, chosen, shares = [], [], []
    for name in names:
        rng = np.random.default_rng([seed, int(name[:2]), int(name[3:])])
        recording = recorded(name, wandering, rng)
        hidden = lost(recording, together, n_gaps, rng)
        filled_by, values, held_by = zip(*fills(recording, hidden, workers, effort), strict=True)
        errors.append(values)
        chosen.append(filled_by[-1].removeprefix("best: "))
        shares.append(held_by[0])
    means = " | ".join(f"{mean:.1f}" for mean in np.exp(np.log(errors).mean(axis=0)))
    counts = ", ".join(f"{name} {chosen.count(name)}" for name in dict.fromkeys(chosen))
    return f"{means} | {counts} | {np.mean(shares):.3f} ({min(shares):.2f} to {max(shares):.2f})"


def main(effort: str = "normal") -> None:
    """Print tables with a line per kind of gap and wandering of markers."""
    with Workers(os.cpu_count() or 1) as workers:
        for kind, recordings in RECORDINGS.items():
            print(f"{kind}: {', '.join(recordings)}")
            print(f"| lost | wander, mm | {' | '.join(MODELS_ALONE)} | best | chosen | held |")
            print(f"|{'---|' * (len(MODELS_ALONE) + 5)}")
            for seed, what in enumerate(GAPS):
                for wandering in WANDERING:
                    shown = row(recordings, seed, wandering, workers, effort)
                    print(f"| {what} | {wandering:g} | {shown} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
