"""How often `mocapbench inspect` calls real motion a fault, and which planted faults it finds.

First come false alarms: findings a minute in recordings as they are, of markers where there are any
and of joints of skeletons (the CMU database) otherwise. Skeletons were fitted to markers, and many
findings look like faults of these fits: a thumb moves by 70 mm from one frame to the next. Nobody
went through them, so all count. Joints are counted without hands and feet, too. No joints were
mislabelled; gaps of 0.1 to 0.4 s in two at once are cut, ten in each recording, as swaps are sought
beside gaps.

Then spikes of 20, 50 and 200 mm are planted over 1 to 3 frames, and swaps of two joints, near to
each other or not, from one frame to the next or in a gap of 0.1 to 0.4 s that both have.
Takes a minute or two on one core:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/recording_checks.py [MARKER_FILE...]
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.formats import read_measured
from mocapbench.benchmark.recording_checks.file_check import find_all
from mocapbench.benchmark.recording_checks.findings_table import MarkerPaths, find_paths
from mocapbench.benchmark.recording_checks.leaps import find_spikes, find_swaps
from mocapbench.datasets import AcclaimFormat, Recording, frame_rate, joint_trajectories

Array = NDArray[np.float64]

RECORDINGS = (
    *("02_01", "02_05", "07_01", "07_05", "08_03", "09_01", "10_02", "10_05", "11_01", "12_01"),
    *("16_03", "16_11", "16_32", "35_10", "39_05", "64_01", "64_20", "86_01", "61_05", "49_06"),
)
"""Walking, running, jumping, kicking, dancing, acrobatics and swings."""
LONGEST = 2400
"""Frames, of 120 a second."""
PLANTED = 10
"""Faults of a kind in each recording."""
KINDS = ("spike", "jump", "swap", "segment")


def joints(name: str) -> MarkerPaths:
    """Return the paths of the joints of a recording, in millimetres, measured as markers are."""
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    path = folder / "subjects" / name[:2] / f"{name}.amc"
    skeleton = AcclaimFormat().skeleton(path)
    assert skeleton is not None
    motion = AcclaimFormat().read(path)
    motion = motion.frames(np.arange(min(len(motion.times), LONGEST)))
    paths = find_paths(joint_trajectories(skeleton, motion), 120.0)
    moving = np.unique(paths.positions[0].round(3), axis=0, return_index=True)[1]
    noise = np.random.default_rng(0).normal(0.0, 0.2, paths.positions[:, moving].shape)
    names = tuple(paths.names[place] for place in moving)
    return MarkerPaths(names, 10 * paths.positions[:, moving] + noise, 120.0)


def without_ends(paths: MarkerPaths) -> MarkerPaths:
    """Return the paths without those of hands and feet."""
    ends = ("hand", "fingers", "thumb", "wrist", "foot", "toes")
    kept = [place for place, name in enumerate(paths.names) if not name.endswith(ends)]
    names = tuple(paths.names[place] for place in kept)
    return MarkerPaths(names, paths.positions[:, kept], paths.rate)


def alarms(paths: MarkerPaths) -> Counter[str]:
    """Return how many findings there are of each kind."""
    axes = [f"{name}.{axis}" for name in paths.names for axis in "xyz"]
    times = np.arange(len(paths.positions)) / paths.rate
    values = paths.positions.reshape(len(times), -1)
    return Counter(find_all(Recording("", times, values, axes, ["mm"] * len(axes)))["kind"])


def starts(paths: MarkerPaths) -> Array:
    """Return frames at which to plant faults, far from each other."""
    return np.linspace(30, len(paths.positions) - 90, PLANTED).astype(int)


def pair(paths: MarkerPaths, frame: int, near: bool, rng: np.random.Generator) -> tuple[int, int]:
    """Return two joints at least 50 mm apart, the nearest or any."""
    one = int(rng.integers(len(paths.names)))
    away = np.linalg.norm(paths.positions[frame] - paths.positions[frame, one], axis=1)
    others = np.flatnonzero(away > 50.0)
    other = others[np.argmin(away[others])] if near else rng.choice(others)
    return one, int(other)


def with_gaps(paths: MarkerPaths, rng: np.random.Generator) -> MarkerPaths:
    """Return the paths with gaps in two joints at once."""
    positions = paths.positions.copy()
    for frame in starts(paths):
        both = pair(paths, frame, bool(rng.integers(2)), rng)
        positions[frame : frame + rng.integers(12, 49), list(both)] = np.nan
    return paths._replace(positions=positions)


def spikes_found(paths: MarkerPaths, size: float, length: int, rng: np.random.Generator) -> int:
    """Return how many planted spikes are found."""
    positions, planted = paths.positions.copy(), []
    for frame in starts(paths):
        marker = int(rng.integers(len(paths.names)))
        way = rng.normal(size=3)
        shaky = size * (way / np.linalg.norm(way) + rng.normal(0.0, 0.1, (length, 3)))
        positions[frame : frame + length, marker] += shaky
        planted.append(((paths.names[marker],), frame))
    found = find_spikes(paths._replace(positions=positions))
    found = found[found["kind"] == "spike"]
    return sum(
        bool(
            (
                (found["markers"] == names)
                & (found["start"] < frame + length)
                & (found["stop"] > frame)
            ).any()
        )
        for names, frame in planted
    )


def swaps_found(paths: MarkerPaths, near: bool, gap: bool, rng: np.random.Generator) -> int:
    """Return how many planted swaps are found."""
    total = 0
    for frame in starts(paths):
        one, other = pair(paths, frame, near, rng)
        positions = paths.positions.copy()
        positions[frame:, [one, other]] = positions[frame:, [other, one]]
        length = int(rng.integers(12, 49)) if gap else 0
        positions[frame : frame + length, [one, other]] = np.nan
        found = find_swaps(paths._replace(positions=positions))
        names = {paths.names[one], paths.names[other]}
        total += any(
            set(markers) == names and frame <= start <= frame + length
            for markers, start in zip(found["markers"], found["start"], strict=True)
        )
    return total


def rate_lines(kind: str, paths: list[MarkerPaths]) -> Iterator[str]:
    """Yield false alarms a minute of recordings."""
    minutes = sum(len(each.positions) / each.rate / 60 for each in paths)
    found: Counter[str] = sum(map(alarms, paths), Counter())
    rates = " | ".join(f"{found[name] / minutes:.2f}" for name in KINDS)
    yield f"| {kind} ({minutes:.2f} min) | {rates} |"


def main(*files: str) -> None:
    """Print false alarms a minute, then the shares of planted faults that are found."""
    clean = [*map(joints, RECORDINGS)]
    print(f"| findings a minute in | {' | '.join(KINDS)} |\n|{'---|' * (len(KINDS) + 1)}")
    cut = [with_gaps(each, np.random.default_rng(k)) for k, each in enumerate(clean)]
    limbs = [*map(without_ends, clean)]
    kinds = {"joints": clean, "joints with gaps": cut, "joints but of hands and feet": limbs}
    for kind, paths in kinds.items():
        print(*rate_lines(kind, paths), sep="\n", flush=True)
    for file in files:
        recording = read_measured(file)
        markers = find_paths(recording, frame_rate(recording))
        print(*rate_lines(Path(file).name, [markers]), sep="\n", flush=True)
    n_planted = len(clean) * PLANTED
    for size in (20.0, 50.0, 200.0):
        for length in (1, 2, 3):
            rng = np.random.default_rng([int(size), length])
            found = sum(spikes_found(each, size, length, rng) for each in clean)
            print(f"spikes of {size:g} mm over {length}: {found / n_planted:.1%}", flush=True)
    for near in (True, False):
        for gap in (False, True):
            rng = np.random.default_rng([near, gap])
            found = sum(swaps_found(each, near, gap, rng) for each in clean)
            print(f"swaps, near {near}, in a gap {gap}: {found / n_planted:.1%}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
