"""Kill runs at random and resume them: ``python docs/evidence/kills.py KILLS [OPTION…]``.

The options are those of ``mocapbench run``, such as ``--profile smoke``. Every process of the run
is killed at once (SIGKILL to the process group) after a random time; the same command then resumes,
until it ends by itself. Its records are compared with those of a run that nobody killed.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import psutil


def found(run: Path) -> dict[tuple[Any, ...], Any]:
    """Return what does not depend on the clock of every record of a run, by its address."""
    address, results = ("task", "case", "label", "fold"), ("status", "scores", "parts", "left_out")
    documents = [json.loads(path.read_text()) for path in (run / "records").rglob("*.json")]
    return {
        tuple(document[name] for name in address): [document[name] for name in results]
        for document in documents
    }


def ends(command: list[str], scratch: Path, seconds: float) -> bool:
    """Return whether a run ended before it was killed, which none of its processes may survive."""
    run = subprocess.Popen(
        command,
        env=os.environ | {"TMPDIR": str(scratch)},
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        said, _ = run.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        run.communicate()
        time.sleep(0.5)
        orphans = [p for p in psutil.process_iter() if is_of(p, run.pid)]
        assert not orphans, f"left behind: {orphans}"
        return False
    assert run.returncode == 0, said
    assert "damaged" not in said, said
    left_behind = list(scratch.glob("mocapbench-*"))
    assert not left_behind, f"left behind: {left_behind}"
    return True


def is_of(process: psutil.Process, session: int) -> bool:
    """Return whether a process belongs to a session and still runs."""
    try:
        return os.getsid(process.pid) == session and process.status() != psutil.STATUS_ZOMBIE
    except (ProcessLookupError, psutil.NoSuchProcess):
        return False


def main(wanted: int, options: list[str]) -> None:
    """Kill so many runs, and print how many of those that were resumed ended identically."""
    command = ["mocapbench", "run", "--offline", *options, "--out"]
    draw, kills, cycles = random.Random(0), 0, 0
    with TemporaryDirectory() as folder:
        reference, out = Path(folder, "reference"), Path(folder, "out-0")
        scratch = Path(folder, "scratch")
        scratch.mkdir()
        began = time.monotonic()
        assert ends([*command, str(reference)], scratch, 3600.0)
        whole = time.monotonic() - began
        while kills < wanted:
            if not ends([*command, str(out)], scratch, draw.uniform(1.0, max(8.0, whole / 2))):
                kills += 1
                continue
            assert found(out) == found(reference), f"{out} differs"
            assert not list(out.rglob("*.tmp")), f"{out} holds temporary files"
            cycles += 1
            out = Path(folder, f"out-{cycles}")
            print(f"{kills} kills, {cycles} runs ended as if nobody had killed them", flush=True)
        assert ends([*command, str(out)], scratch, 3600.0)
        assert found(out) == found(reference), f"{out} differs"
        print(f"{kills} kills, {cycles + 1} runs ended as if nobody had killed them")


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
