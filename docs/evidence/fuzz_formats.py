"""Damage files in many ways, and count what reading them gives; see docs/formats.md.

    python docs/evidence/fuzz_formats.py 10000 walk.c3d walk.bvh

A skeleton (.asf) is damaged beside a motion of the same name. Reading may give a recording or a
`FormatError`, also without a rate and with rows added that are missing; a recording is written with
its gaps filled. Anything else is printed and ends with exit code 1.
"""

import random
import resource
import shutil
import sys
import time
import traceback
import warnings
from collections import Counter
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mocapbench.benchmark import format_for
from mocapbench.benchmark.testing import damage_bytes
from mocapbench.datasets import Format, FormatError, Recording


def outcome(kind: Format, path: Path) -> str:
    """Return what reading a file gave, in a word or two."""
    try:
        recording = kind.read(path, 100.0)
        kind.likelihoods(path)
        for other in (kind.with_missing_rows(), kind):
            write_filled(other, path)
        with suppress(FormatError):  # as nothing may tell the times
            kind.read(path)
    except FormatError as error:
        crashed = "crash of the library" in error.got
        late = "no end of reading" in error.got
        return "library crashed" if crashed else "too long" if late else "FormatError"
    except Exception:
        traceback.print_exc()
        return "defect"
    return "recording" if isinstance(recording, Recording) else "defect"


def write_filled(kind: Format, path: Path) -> None:
    """Write a file with something in its gaps, and read that."""
    recording, out = kind.read(path, 100.0), path.with_name(f"out{path.suffix}")
    kind.write(out, recording.with_values(np.nan_to_num(recording.values, nan=1.5)), like=path)
    kind.read(out, 100.0)


def fuzz(path: Path, n_times: int) -> Counter[str]:
    """Return how often each outcome came of reading damaged copies of a file."""
    motion = path.with_suffix(".amc") if path.suffix == ".asf" else path
    kind, rng = format_for(motion), random.Random(0)
    counts: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        copy = Path(folder, path.name)
        for beside in {*path.parent.glob("*.asf"), motion}:
            shutil.copy(beside, folder)
        for _ in range(n_times):
            copy.write_bytes(damage_bytes(path.read_bytes(), rng))
            counts[outcome(kind, copy.with_name(motion.name))] += 1
    return counts


def main(n_times: str, *paths: str) -> int:
    """Fuzz every file, and print a line for each."""
    warnings.simplefilter("ignore")
    defects = 0
    for path in map(Path, paths):
        started = time.perf_counter()
        counts = fuzz(path, int(n_times))
        seconds = time.perf_counter() - started
        told = ", ".join(f"{count} {what}" for what, count in sorted(counts.items()))
        print(f"{path.name}: {n_times} files in {seconds:.0f} s: {told}", flush=True)
        defects += counts["defect"]
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
    print(f"at most {peak:.0f} MiB of memory")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
