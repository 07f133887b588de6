"""How often `mocapbench inspect` calls real motion a fault, and which planted faults it finds.

First come false alarms: findings a minute in recordings as they are, of joints and of joint angles
of CMU's skeletons, and of markers in files of your own. Skeletons were fitted to markers, and many
findings look like faults of these fits: a thumb turns by 180 degrees and back. Nobody went through
them, so all count. Joints are counted without hands and feet, too. No joints were mislabelled; gaps
of 0.1 to 0.4 s in two at once are cut, ten in each recording, as swaps are sought across gaps.

Then spikes of 20, 50 and 200 mm are planted over 1 to 3 frames, and swaps of two joints or markers,
near to each other or not, from one frame to the next or in a gap that both have. Takes some minutes
on one core:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/recording_checks.py [MARKER_FILE...]
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.formats import read_measured
from mocapbench.benchmark.recording_checks.file_check import find_all
from mocapbench.benchmark.recording_checks.leaps import find_spikes
from mocapbench.benchmark.recording_checks.paths import find_marker_paths
from mocapbench.benchmark.recording_checks.swaps import find_swaps
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
GAPS = {"none": (0.0, 0.0), "0.1 to 0.4 s": (0.1, 0.4), "0.5 to 1 s": (0.5, 1.0)}
KINDS = ("spike", "jump", "swap", "segment")


def angles(name: str) -> Recording:
    """Return a recording of the CMU database, cut to so many frames."""
    motion = AcclaimFormat().read(path_of(name))
    return motion.frames(np.arange(min(len(motion.times), LONGEST)))


def path_of(name: str) -> Path:
    """Return where a recording is."""
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    return folder / "subjects" / name[:2] / f"{name}.amc"


def joints(name: str) -> Recording:
    """Return the joints of a recording, in millimetres, measured as markers are."""
    skeleton = AcclaimFormat().skeleton(path_of(name))
    assert skeleton is not None
    recording = joint_trajectories(skeleton, angles(name))
    names, positions = split(recording)
    moving = np.unique(positions[0].round(3), axis=0, return_index=True)[1]
    noise = np.random.default_rng(0).normal(0.0, 0.2, positions[:, moving].shape)
    return record([names[place] for place in moving], 10 * positions[:, moving] + noise, 120.0)


def split(recording: Recording) -> tuple[Sequence[str], Array]:
    """Return the markers of a recording and their positions (N, M, 3)."""
    paths = find_marker_paths(recording)
    return paths.names, paths.positions


def record(names: Sequence[str], positions: Array, rate: float) -> Recording:
    """Return markers at positions (N, M, 3) as a recording."""
    axes = tuple(f"{name}.{axis}" for name in names for axis in "xyz")
    times = np.arange(len(positions)) / rate
    return Recording("", times, positions.reshape(len(times), -1), axes, ("mm",) * len(axes))


def move(recording: Recording, positions: Array) -> Recording:
    """Return a recording whose markers are elsewhere."""
    return record(split(recording)[0], positions, frame_rate(recording))


def without_ends(recording: Recording) -> Recording:
    """Return a recording of joints without those of hands and feet."""
    ends = ("hand", "fingers", "thumb", "wrist", "foot", "toes")
    kept = [name for name in recording.channels if not name.split(".")[0].endswith(ends)]
    return recording.select(kept)


def starts(recording: Recording) -> Array:
    """Return frames at which to plant faults, far from each other."""
    last = len(recording.times) - 30 - round(0.5 * frame_rate(recording))
    return np.linspace(30, last, PLANTED).astype(int)


def pair(positions: Array, frame: int, near: bool, rng: np.random.Generator) -> tuple[int, int]:
    """Return two visible markers at least 40 mm apart, the nearest or any."""
    seen = np.flatnonzero(~np.isnan(positions[frame - 1, :, 0]))
    one = int(rng.choice(seen))
    away = np.linalg.norm(positions[frame - 1, seen] - positions[frame - 1, one], axis=1)
    others = seen[away > 40.0]
    other = others[np.argmin(away[away > 40.0])] if near else rng.choice(others)
    return one, int(other)


def with_gaps(recording: Recording, rng: np.random.Generator) -> Recording:
    """Return a recording with gaps in two markers at once."""
    positions = split(recording)[1].copy()
    for frame in starts(recording):
        both = pair(positions, frame, bool(rng.integers(2)), rng)
        positions[frame : frame + rng.integers(12, 49), list(both)] = np.nan
    return move(recording, positions)


def spikes_found(recording: Recording, size: float, length: int, rng: np.random.Generator) -> int:
    """Return how many planted spikes are found."""
    names, positions = split(recording)
    positions, planted = positions.copy(), []
    for frame in starts(recording):
        marker = int(rng.integers(len(names)))
        way = rng.normal(size=3)
        shaky = size * (way / np.linalg.norm(way) + rng.normal(0.0, 0.1, (length, 3)))
        positions[frame : frame + length, marker] += shaky
        planted.append(((names[marker],), frame))
    found = find_spikes(find_marker_paths(move(recording, positions)))
    found = found[found["kind"] == "spike"]
    return sum(
        bool(
            (
                (found["markers"] == marker)
                & (found["start"] < frame + length)
                & (found["stop"] > frame)
            ).any()
        )
        for marker, frame in planted
    )


def swaps_found(
    recording: Recording, near: bool, gap: tuple[float, float], rng: np.random.Generator
) -> int:
    """Return how many planted swaps are found."""
    names, whole = split(recording)
    total = 0
    for frame in starts(recording):
        one, other = pair(whole, frame, near, rng)
        positions = whole.copy()
        positions[frame:, [one, other]] = positions[frame:, [other, one]]
        length = round(rng.uniform(*gap) * frame_rate(recording))
        positions[frame : frame + length, [one, other]] = np.nan
        found = find_swaps(find_marker_paths(move(recording, positions)))
        both = {names[one], names[other]}
        total += any(
            set(markers) == both and frame <= start <= frame + length
            for markers, start in zip(found["markers"], found["start"], strict=True)
        )
    return total


def rate_lines(kind: str, recordings: list[Recording]) -> Iterator[str]:
    """Yield false alarms a minute of recordings."""
    minutes = sum(len(each.times) / frame_rate(each) / 60 for each in recordings)
    found: Counter[str] = sum((Counter(find_all(each)["kind"]) for each in recordings), Counter())
    rates = " | ".join(f"{found[name] / minutes:.2f}" for name in KINDS)
    yield f"| {kind} ({minutes:.2f} min) | {rates} |"


def main(*files: str) -> None:
    """Print false alarms a minute, then the shares of planted faults that are found."""
    clean = [*map(joints, RECORDINGS)]
    markers = {Path(file).name: read_measured(file) for file in files}
    print(f"| findings a minute in | {' | '.join(KINDS)} |\n|{'---|' * (len(KINDS) + 1)}")
    kinds = {
        "joints": clean,
        "joints with gaps": [with_gaps(r, np.random.default_rng(k)) for k, r in enumerate(clean)],
        "joints but of hands and feet": [*map(without_ends, clean)],
        "angles": [*map(angles, RECORDINGS)],
        **{name: [recording] for name, recording in markers.items()},
    }
    for kind, recordings in kinds.items():
        print(*rate_lines(kind, recordings), sep="\n", flush=True)
    for size in (20.0, 50.0, 200.0):
        for length in (1, 2, 3):
            rng = np.random.default_rng([int(size), length])
            found = sum(spikes_found(each, size, length, rng) for each in clean)
            share = found / (len(clean) * PLANTED)
            print(f"spikes of {size:g} mm over {length}: {share:.1%}", flush=True)
    for kind, recordings in {"joints": clean, "markers": [*markers.values()]}.items():
        for near in (True, False):
            for name, gap in GAPS.items():
                rng = np.random.default_rng([near, len(name)])
                able = [each for each in recordings if np.ptp(each.times) > 1 + 2 * gap[1]]
                found = sum(swaps_found(each, near, gap, rng) for each in able)
                share = found / max(len(able) * PLANTED, 1)
                print(f"swaps of {kind}, near {near}, gap {name}: {share:.1%}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
