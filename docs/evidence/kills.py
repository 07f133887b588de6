"""Kill commands at random moments (SIGKILL), and look at what that leaves and how they go on.

    python docs/evidence/kills.py --kills 1000 --seed 0 [CASE…]

A command is started, killed and started again, several times, and then ends by itself. At random
its whole session dies, or only the process that others must notice the death of. Counted are

- orphans: processes that live on, and what workers of a cluster keep for a client that is gone,
- half files: those that are neither as before nor as a command writes that nobody killed, unless
  their names say that they are temporary,
- leftovers: all files, wherever temporary ones may be, that such a command does not leave, but for
  the empty files that run directories and dask keep for their locks,
- unequal ends: results that are not those of such a command.

All must be 0, or else the exit code is 1.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import psutil

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "helpers"))
import format_files

MAIN = ("-c", "from mocapbench.benchmark.cli.main import main; main()")
SMOKE = ("run", "--offline", "--profile", "smoke", "--folds", "1", "--models", "trivial,linear")
TOY = tuple((*SMOKE, "--tasks", f"toy-interpolation-{number}") for number in (1, 2))
TEMPORARY = ".mocapbench-tmp-"
LOCKS = {"mocapbench.lock", "global.lock", "purge.lock"}  # of run directories, and of dask
MOST_KILLS = 8
"""Of one command, before it may end by itself."""
PATIENCE = 60.0
"""Seconds for which processes may take note of what happened to another."""
COUNTED = ("orphans", "half files", "leftovers", "unequal ends")


@dataclass(frozen=True)
class Case:
    """A command, what it needs, and who is killed."""

    words: tuple[str, ...]
    prepare: Callable[[Path], object]
    victim: str = "command"


class Cluster:
    """A dask scheduler and two workers."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{port}"
        self.scheduler = self.start("scheduler", "--host", "127.0.0.1", "--port", str(port))
        self.workers = [self.start_worker() for _ in range(2)]

    def start_worker(self) -> subprocess.Popen[bytes]:
        """Start a worker."""
        return self.start("worker", self.address, "--nthreads", "1", "--local-directory", "tmp")

    def start(self, role: str, *options: str) -> subprocess.Popen[bytes]:
        """Start a process of the cluster."""
        module = ("-m", f"distributed.cli.dask_{role}", *options, "--no-dashboard")
        return start(self.folder, *module)

    def kill(self, role: str, draw: random.Random) -> subprocess.Popen[bytes]:
        """Kill the scheduler, or a worker in place of which another one starts."""
        if role == "scheduler":
            return kill(self.scheduler, draw)
        killed = kill(draw.choice(self.workers), draw)
        self.workers.append(self.start_worker())
        return killed

    def forgets_runs(self) -> bool:
        """Return whether workers delete what they have of a run."""
        kept = "tmp/dask-scratch-space/*/" + TEMPORARY + "*"
        return wait_until(lambda: not [*self.folder.glob(kept)])

    def stop(self) -> list[subprocess.Popen[bytes]]:
        """End all processes, and return them."""
        processes = [*self.workers, self.scheduler]
        for process in processes:
            process.terminate()
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:  # it started, and waits for a scheduler that is gone
                process.kill()
                process.wait()
        return processes


def start(folder: Path, *words: str) -> subprocess.Popen[bytes]:
    """Start Python in a folder and a session of its own, with temporary files below the folder."""
    (folder / "tmp").mkdir(exist_ok=True)
    return subprocess.Popen(
        [sys.executable, "-P", *words],
        cwd=folder,
        env=os.environ
        | {"TMPDIR": str(folder / "tmp"), "OPENBLAS_NUM_THREADS": "1", "PYTHONSAFEPATH": "1"},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def kill(process: subprocess.Popen[bytes], draw: random.Random) -> subprocess.Popen[bytes]:
    """Kill a process, or with it all of its session."""
    draw.choice([os.kill, os.killpg])(process.pid, signal.SIGKILL)
    process.wait()
    return process


def wait_until(holds: Callable[[], bool]) -> bool:
    """Return whether something comes to hold within some time."""
    latest = time.monotonic() + PATIENCE
    while not (held := holds()) and time.monotonic() < latest:
        time.sleep(0.2)
    return held


def list_sessions(leaders: Collection[subprocess.Popen[bytes]]) -> list[psutil.Process]:
    """Return what lives in the sessions of processes."""
    sessions, found = {leader.pid for leader in leaders}, []
    for process in psutil.process_iter():
        with suppress(OSError, psutil.Error):
            alive = process.status() != psutil.STATUS_ZOMBIE
            if alive and os.getsid(process.pid) in sessions:
                found.append(process)
    return found


def attempt(
    case: Case, folder: Path, seconds: float, draw: random.Random, seen: Counter[str]
) -> int | None:
    """Start a command, kill the victim after some time, and return how the command ended.

    None stands for a command that has to be given again.
    """
    cluster = None if case.victim == "command" else Cluster(folder)
    to = ("--scheduler", cluster.address) if cluster else ()
    command = start(folder, *MAIN, *case.words, *to)
    involved = [command]
    try:
        command.wait(seconds)
    except subprocess.TimeoutExpired:
        seen["kills"] += 1
        if cluster is None or case.victim == "client":
            kill(command, draw)
        else:
            involved.append(cluster.kill(case.victim, draw))
            command.wait()
    if cluster:
        seen["orphans"] += case.victim == "client" and not cluster.forgets_runs()
        involved += cluster.stop()
    if not wait_until(lambda: not list_sessions(involved)):
        for orphan in list_sessions(involved):
            print(f"orphan: {orphan}", flush=True)
            seen["orphans"] += 1
            orphan.kill()
    lost = case.victim == "scheduler" and command.returncode == 2
    return None if lost or command.returncode < 0 else command.returncode


def read_results(folder: Path) -> dict[str, Any]:
    """Return what does not depend on the clock of all files, by their paths."""
    return {
        str(path.relative_to(folder)): read_result(path)
        for path in folder.rglob("*")
        if path.is_file() and path.name not in LOCKS and path.suffix != ".dirlock"
    }


def read_result(path: Path) -> Any:
    """Return what does not depend on the clock of a file; what is wrong if it is not whole."""
    try:
        if path.parent.parent.name == "records":
            record = json.loads(path.read_bytes())
            return [record[key] for key in ("status", "scores", "parts", "left_out")]
        if path.parent.parent.name == "predictions":
            with np.load(path) as arrays:
                return {key: arrays[key].tobytes() for key in arrays if key != "about"}
        if path.name == "plan.json":
            return json.loads(path.read_bytes())["keys"]
        if path.suffix == ".html":
            return path.read_bytes().rstrip().endswith(b"</html>")
    except Exception as error:
        return repr(error)
    return sha256(path.read_bytes()).hexdigest()


def count_half_files(folder: Path, before: Mapping[str, Any], whole: Mapping[str, Any]) -> int:
    """Return how many files are neither as before nor as they should become."""
    found = read_results(folder).items()
    known = [(path, value) for path, value in found if path in before or path in whole]
    return sum(
        value != before.get(path) and value != whole.get(path)
        for path, value in known
        if TEMPORARY not in path
    )


def repeat(
    case: Case, places: tuple[Path, Path], most: int, draw: random.Random, seen: Counter[str]
) -> None:
    """Kill a command several times until it ends by itself, and count what is wrong then."""
    given, reference = places
    if not reference.exists():
        given.mkdir(parents=True)
        case.prepare(given)
        shutil.copytree(given, reference)
        began = time.monotonic()
        assert attempt(case, reference, 600.0, draw, Counter()) == 0, case
        (reference / ".seconds").write_text(str(time.monotonic() - began))
    seconds = float((reference / ".seconds").read_text())
    before, whole = read_results(given), read_results(reference)
    folder = given.with_name("folder")
    shutil.copytree(given, folder)
    code, kills = None, seen["kills"]
    while code is None:
        killing = seen["kills"] - kills < most
        moment = draw.uniform(0.0, 1.1 * seconds) if killing else 600.0
        code = attempt(case, folder, moment, draw, seen)
        seen["half files"] += count_half_files(folder, before, whole)
    if case.victim in ("worker", "scheduler"):  # what these left goes when the next run starts
        code = attempt(case, folder, 600.0, draw, seen)
    whole.pop(".seconds")
    found = read_results(folder)
    for path in sorted(found.keys() - whole.keys()):
        print(f"left: {path}", flush=True)
    seen["leftovers"] += len(found.keys() - whole.keys())
    differing = sorted(path for path in whole if found.get(path) != whole[path])
    if differing or code not in (0, 2):  # 2: what was killed had written all, and is kept
        print(f"exit code {code}, differing: {differing}", flush=True)
    seen["unequal ends"] += bool(differing) or code not in (0, 2)
    shutil.rmtree(folder)


def give(folder: Path, *words: str) -> None:
    """Give a command that nobody kills."""
    assert start(folder, *MAIN, *words).wait() == 0, words


def prepare_nothing(_: Path) -> None:
    """Leave a folder empty."""


def prepare_runs(folder: Path) -> None:
    """Write two runs."""
    for name, words in zip(("run", "other"), TOY, strict=True):
        give(folder, *words, "--no-report", "--out", name)


def prepare_reference(folder: Path) -> None:
    """Write a run of two tasks, and reference values of which each file is to change."""
    prepare_runs(folder)
    give(folder, "merge", "run", "other", "--out", "both")
    give(folder, "check", "run", "--reference", "reference", "--update")
    (path,) = (folder / "reference").iterdir()
    text = path.read_text()
    path.write_text(text.replace("linear", "gone"))
    path.with_name("gone.csv").write_text(text.replace("toy-interpolation-1", "gone"))


def prepare_walks(folder: Path) -> None:
    """Write recordings of several formats."""
    (folder / "walks").mkdir()
    for kind in FILLED:
        format_files.sample(kind, folder / "walks")


FILLED = {
    "bvh": ("walk.bvh", "--frames", "20:30"),
    "c3d": ("markers.c3d",),
    "csv": ("walk.csv",),
    "npz": ("walk.npz",),
    "parquet": ("walk.parquet",),
    "trc": ("markers.trc",),
}
CASES = {
    "run": Case((*TOY[0], "--out", "out"), prepare_nothing),
    "report": Case(("report", "--out", "run"), prepare_runs),
    "merge": Case(("merge", "run", "other", "--out", "out"), prepare_runs),
    "merge-into": Case(("merge", "other", "--out", "run"), prepare_runs),
    "check": Case(("check", "both", "--reference", "reference", "--update"), prepare_reference),
    "init": Case(("init", "task.toml", "--recordings", "walks"), prepare_walks),
    **{
        f"fill-{kind}": Case(("fill", f"walks/{file}", "--model", "linear", *gap), prepare_walks)
        for kind, (file, *gap) in FILLED.items()
    },
    **{
        f"dask-{role}": Case((*TOY[0], "--out", "out"), prepare_nothing, role)
        for role in ("client", "worker", "scheduler")
    },
}


def main() -> int:
    """Kill commands, and say what that did."""
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("--kills", type=int, default=1000)
    options.add_argument("--seed", type=int, default=0)
    options.add_argument("cases", nargs="*", choices=[*CASES, []], metavar="CASE")
    chosen = options.parse_args()
    draw, seen = random.Random(chosen.seed), Counter[str]()
    with TemporaryDirectory() as base:
        while seen["kills"] < chosen.kills:
            for name in chosen.cases or CASES:
                most = min(MOST_KILLS, chosen.kills - seen["kills"])
                places = Path(base, name, "given"), Path(base, name, "reference")
                repeat(CASES[name], places, most, draw, seen)
                counts = ", ".join(f"{seen[what]} {what}" for what in ("kills", *COUNTED))
                print(f"{name}: {counts}", flush=True)
    return int(any(seen[what] for what in COUNTED))


if __name__ == "__main__":
    sys.exit(main())
