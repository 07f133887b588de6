"""Whether a file is filled by the same bits again: idle, beside busy loops, by one process or two.

    python docs/evidence/repeat_fills.py FILE [TIMES]

Fills a file of gaps so many times in each way, ten by default, and prints how many different
results there are. More than one is a defect.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from hashlib import sha256
from pathlib import Path

WAYS = ((1, 0), (2, 0), (1, 2), (2, 2))
"""How many processes fill, and how many busy loops run beside them."""
BUSY = "while True: pass"


@contextmanager
def keep_busy(n_loops: int) -> Iterator[None]:
    """Run so many loops that never rest."""
    with ExitStack() as loops:
        for _ in range(n_loops):
            loop = loops.enter_context(subprocess.Popen([sys.executable, "-c", BUSY]))
            loops.callback(loop.kill)
        yield


def digest_fill(file: Path, n_jobs: int) -> str:
    """Fill a file, and return the digest of the filled copy and the table of its entries."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mocapbench", "fill", str(file), "--jobs", str(n_jobs), "--out", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        written = [Path(folder, name) for name in (file.name, f"{file.name}.entries.csv")]
        return sha256(b"".join(path.read_bytes() for path in written)).hexdigest()[:12]


def main(file: Path, times: int) -> None:
    """Print the digests, with how often each of them came, for each way."""
    found: Counter[str] = Counter()
    for n_jobs, n_loops in WAYS:
        with keep_busy(n_loops):
            of_way = Counter(digest_fill(file, n_jobs) for _ in range(times))
        print(f"--jobs {n_jobs}, {n_loops} busy loops: {dict(of_way)}", flush=True)
        found += of_way
    print(f"{len(found)} different result{'s' * (len(found) > 1)} of {found.total()} fills")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10)
