"""Seconds and memory of ``mocapbench fill`` for recordings of half an hour.

::

    python docs/evidence/big_inputs.py [MODEL] [MINUTES] [SUFFIX ...]

makes a recording of 50 markers at 120 frames a second, with a gap of each marker about every 15 s,
as C3D, CSV and TRC, fills each file by MODEL (linear), and prints for each the seconds, the peak
memory of all processes together and of the largest one, and what the command says first.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from math import isnan
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import psutil

from mocapbench.basics.arrays import Array

RATE, N_MARKERS, APART = 120, 50, 15
SHORTEST, LONGEST = 5, 60
"""Frames of a gap."""
WORD, BLOCK = 2, 512
"""Bytes of C3D."""
NAMES = [f"M{number:02d}" for number in range(N_MARKERS)]


def make_markers(minutes: float) -> Array:
    """Return positions in millimetres (N, markers, 3), NaN in gaps, that swing about a walk."""
    rng, n_frames = np.random.default_rng(0), round(minutes * 60 * RATE)
    times = np.arange(n_frames) / RATE
    points = np.empty((n_frames, N_MARKERS, 3), dtype=np.float32)
    for marker, axis in np.ndindex(N_MARKERS, 3):
        frequency, phase = rng.uniform(0.5, 1.5), rng.uniform(0, 2 * np.pi)
        swing = 150 * np.sin(2 * np.pi * frequency * times + phase)
        points[:, marker, axis] = rng.uniform(200, 1800) + swing + rng.normal(0, 0.1, n_frames)
    for marker in range(N_MARKERS):
        for start in range(RATE, n_frames - APART * RATE, APART * RATE):
            first = start + int(rng.integers((APART - 1) * RATE))
            points[first : first + int(rng.integers(SHORTEST, LONGEST)), marker] = np.nan
    return np.round(points, 3)


def list_rows(points: Array) -> Iterator[list[str]]:
    """Yield the time and the coordinates of each frame, as text that is empty in gaps."""
    for frame, row in enumerate(points.reshape(len(points), -1).tolist()):
        yield [f"{frame / RATE:.6f}", *("" if isnan(v) else f"{v:.3f}" for v in row)]


def write_csv(path: Path, points: Array) -> None:
    """Write a table of comma-separated values."""
    head = ["time", *(f"{name}.{axis} [mm]" for name in NAMES for axis in "xyz")]
    with path.open("w", encoding="utf-8") as file:
        file.writelines(f"{','.join(row)}\n" for row in (head, *list_rows(points)))


def write_trc(path: Path, points: Array) -> None:
    """Write a table as OpenSim has it."""
    facts: dict[str, float | str] = {"DataRate": RATE, "CameraRate": RATE, "NumFrames": len(points)}
    facts |= {"NumMarkers": N_MARKERS, "Units": "mm"}
    head = [
        ["PathFileType", "4", "(X/Y/Z)", path.name],
        [*facts],
        [*map(str, facts.values())],
        ["Frame#", "Time", *(cell for name in NAMES for cell in (name, "", ""))],
        ["", "", *(f"{axis}{k + 1}" for k in range(N_MARKERS) for axis in "XYZ")],
        [],
    ]
    with path.open("w", encoding="utf-8") as file:
        file.writelines("\t".join(line) + "\n" for line in head)
        for number, row in enumerate(list_rows(points), start=1):
            file.write("\t".join([str(number), *row]) + "\n")


def write_c3d(path: Path, points: Array) -> None:
    """Write points in floating-point numbers of Intel, without analogue samples."""
    parameters = compose_parameters(len(points))
    header = np.zeros(BLOCK // WORD, dtype="<u2")
    header[:2] = 0x5002, N_MARKERS
    header[3:5] = 1, min(len(points), 0xFFFF)
    header[6:8] = np.array([-1.0], dtype="<f4").view("<u2")
    header[8] = 2 + len(parameters) // BLOCK
    header[10:12] = np.array([RATE], dtype="<f4").view("<u2")
    hidden = np.isnan(points).any(axis=2, keepdims=True)
    stored = np.concatenate([np.nan_to_num(points), np.where(hidden, -1.0, 0.0)], axis=2)
    with path.open("wb") as file:
        file.write(header.tobytes() + parameters)
        stored.astype("<f4").tofile(file)


def compose_parameters(n_frames: int) -> bytes:
    """Return the parameters of the group POINT, in whole blocks."""
    group = bytes([5, 0xFF]) + b"POINT" + (3).to_bytes(2, "little") + b"\0"
    data = group + b"".join(
        compose_parameter(name, size, shape, content)
        for name, size, shape, content in (
            ("USED", 2, [], np.int16(N_MARKERS).tobytes()),
            ("FRAMES", 4, [], np.float32(n_frames).tobytes()),
            ("RATE", 4, [], np.float32(RATE).tobytes()),
            ("SCALE", 4, [], np.float32(-1.0).tobytes()),
            ("UNITS", -1, [2], b"mm"),
            ("LABELS", -1, [4, N_MARKERS], "".join(f"{n:4}" for n in NAMES).encode()),
        )
    )
    n_blocks = -(-(4 + len(data)) // BLOCK)
    return (bytes([1, 0x50, n_blocks, 84]) + data).ljust(n_blocks * BLOCK, b"\0")


def compose_parameter(name: str, size: int, shape: list[int], content: bytes) -> bytes:
    """Return a parameter of the first group, the kind of its values given by their size."""
    body = bytes([size & 0xFF, len(shape), *shape]) + content + b"\0"
    return bytes([len(name), 1]) + name.encode() + (2 + len(body)).to_bytes(2, "little") + body


WRITERS: Mapping[str, Callable[[Path, Array], None]] = {
    "c3d": write_c3d,
    "csv": write_csv,
    "trc": write_trc,
}


def measure(command: list[str]) -> tuple[float, float, float, str]:
    """Return the seconds of a command, MB of all its processes and the largest, and its words."""
    began, most, largest = time.perf_counter(), 0, 0
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    watched = psutil.Process(process.pid)
    while process.poll() is None:
        sizes = [*measure_sizes([watched, *list_children(watched)])]
        most, largest = max(most, sum(sizes)), max([largest, *sizes])
        time.sleep(0.02)
    words = process.stdout.read() if process.stdout else ""
    return time.perf_counter() - began, most / 1e6, largest / 1e6, words


def list_children(process: psutil.Process) -> list[psutil.Process]:
    """Return all processes that a process started."""
    try:
        return process.children(recursive=True)
    except psutil.Error:
        return []


def measure_sizes(processes: list[psutil.Process]) -> Iterator[int]:
    """Yield the bytes of memory of each process; what several share is shared out among them."""
    for process in processes:
        try:
            yield process.memory_full_info().pss
        except psutil.Error:  # it has ended
            yield 0


def main(model: str = "linear", minutes: str = "30", *suffixes: str) -> None:
    """Fill a file of each format."""
    points = make_markers(float(minutes))
    with TemporaryDirectory() as place:
        for suffix in suffixes or WRITERS:
            file, out = Path(place, f"long.{suffix}"), Path(place, suffix)
            WRITERS[suffix](file, points)
            command = ["mocapbench", "fill", str(file), "--model", model, "--out", str(out)]
            seconds, most, largest, words = measure(command)
            print(f"{suffix}: {seconds:.1f} s, {most:.0f} MB, the largest process {largest:.0f} MB")
            print("  " + "\n  ".join(words.splitlines()[:4]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
