"""How well `rigid-body`, other models and the choice of `fill` fill gaps of skin markers.

Markers are fixed to segments of skeletons of the CMU database, three on each of nine, up to 10 cm
from its end, so that where they are is known. Each also wanders on the skin, smoothly within a
quarter of a second, by a standard deviation of 0, 3 or 10 mm in each direction, and is measured
with one of 0.2 mm. Single markers are lost, or all three of a segment. Errors are root mean squared
distances in mm, and of recordings the geometric mean is shown. Takes ten minutes on two cores:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/markers.py [MOST_SECONDS]
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
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
    PCARegression,
    PchipImputer,
    RigidBody,
)
from mocapbench.benchmark.filling.question import Question
from mocapbench.benchmark.filling.trials.choice import choose
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import (
    AcclaimFormat,
    Mask,
    Recording,
    Segment,
    Skeleton,
    joint_trajectories,
)

Array = NDArray[np.float64]

RECORDINGS = ("02_01", "07_01", "09_01", "12_01", "16_03", "39_01", "64_01", "10_02")
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


def recorded(folder: Path, name: str, wandering: float, rng: np.random.Generator) -> Recording:
    """Return the markers of a recording, in millimetres."""
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


def fills(
    recording: Recording, hidden: Mask, workers: Workers, budget: float
) -> Iterator[tuple[str, float]]:
    """Yield what fills, and its error."""
    given = recording.hide(hidden)
    chosen = choose(Question(given, hidden), workers, budget, lambda *_: None).ranking.order[0]
    for name, model in {**MODELS_ALONE, f"best: {chosen}": MODELS.get(chosen)()}.items():
        (prediction,) = model.fit([given]).impute([given])
        yield name, distance(recording, hidden, prediction.mean)


def main(budget: str = "15") -> None:
    """Print a line per kind of gap and wandering of markers: mean errors, and what was chosen."""
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    print(f"| lost | wander, mm | {' | '.join(MODELS_ALONE)} | best | chosen |")
    print(f"|{'---|' * (len(MODELS_ALONE) + 4)}")
    with Workers(os.cpu_count() or 1) as workers:
        for seed, (kind, (together, n_gaps)) in enumerate(GAPS.items()):
            for wandering in WANDERING:
                errors, chosen = [], []
                for name in RECORDINGS:
                    rng = np.random.default_rng([seed, int(name[:2]), int(name[3:])])
                    recording = recorded(folder, name, wandering, rng)
                    hidden = lost(recording, together, n_gaps, rng)
                    names, values = zip(
                        *fills(recording, hidden, workers, float(budget)), strict=True
                    )
                    errors.append(values)
                    chosen.append(names[-1].removeprefix("best: "))
                means = np.exp(np.log(errors).mean(axis=0))
                shown = " | ".join(f"{mean:.1f}" for mean in means)
                counts = ", ".join(f"{n} {chosen.count(n)}" for n in dict.fromkeys(chosen))
                print(f"| {kind} | {wandering:g} | {shown} | {counts} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
