"""Damage run directories in many ways, and count how commands end on them.

    python docs/evidence/fuzz_runs.py 100000 0

Every file of a run may come from anybody. One file at a time is damaged: an entry of another kind,
a huge number, a text of marks of direction, lists in one another, an entry too many or too few,
bytes of another file, a link or a folder in its place. Everything is read from every run, which
may raise nothing but a `UsageError`. One run in ten is given to a command, one in two hundred to
one that draws; these must end with a documented exit code and a message. Anything else is printed
and ends with exit code 1.
"""

import io
import json
import os
import random
import resource
import shutil
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mocapbench.basics.words import printable
from mocapbench.benchmark import RunDirectory, planned_task_files
from mocapbench.benchmark.cli.main import main as mocapbench
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.results.frames import job_table, score_table
from mocapbench.benchmark.results.origins import cell_command
from mocapbench.benchmark.testing import damage_bytes

REQUEST = ("--profile", "smoke", "--tasks", "toy-interpolation-1", "--cases", "test 1")
MODELS = ("--models", "linear,knn", "--folds", "2", "--jobs", "1", "--no-report")
ENDINGS = {0, 1, 2, 3, 4, 5}  # not 70, a defect


def nest(depth: int) -> Any:
    """Return lists in one another."""
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return value


VALUES: tuple[Any, ...] = (
    *(None, True, 0, -1, 1.5, "", "a", [], {}, [None], {"a": None}, [[1, 2], [3]]),
    *(10**9, 10**30, -(10**30), 1e308, 5e-324, float("nan"), float("inf")),
    *("\u202egnp.exe", "\x1b]0;title\x07\x1b[2J", "\ud800", "../../etc/passwd", "/dev/zero", "\0"),
    *("=1+1", "'", '"', "a" * 20_000, "<script>alert(1)</script>", "mocapbench run 'open"),
    *(nest(20), nest(400), {"a": nest(90)}, [0] * 1000, {str(n): n for n in range(1000)}),
)


def choose_entry(value: Any, rng: random.Random) -> tuple[Any, Any]:
    """Return a table or list of a document and one of its keys; those near the top are likely."""
    key = rng.choice([*value]) if isinstance(value, dict) else rng.randrange(len(value))
    child = value[key]
    if isinstance(child, dict | list) and child and rng.random() < 0.7:
        return choose_entry(child, rng)
    return value, key


def replace_entry(holder: Any, key: Any, rng: random.Random) -> None:
    """Give an entry another value: a hostile one, or one from elsewhere in the document."""
    holder[key] = rng.choice(VALUES)


def remove_entry(holder: Any, key: Any, rng: random.Random) -> None:
    """Take an entry away."""
    del rng, holder[key]


def add_entry(holder: Any, key: Any, rng: random.Random) -> None:
    """Add an entry that is a copy of another, or new."""
    match holder:
        case dict():
            holder[rng.choice(("new", "a" * 300, "\u202e", "../up"))] = holder[key]
        case _:
            holder.insert(key, holder[key])


CHANGES: tuple[Callable[[Any, Any, random.Random], None], ...] = (
    replace_entry,
    replace_entry,
    remove_entry,
    add_entry,
)


def damage_document(data: bytes, rng: random.Random) -> bytes:
    """Return a JSON file of which one to three entries are others."""
    document = json.loads(data)
    for _ in range(rng.choice((1, 1, 2, 3))):
        if document:
            rng.choice(CHANGES)(*choose_entry(document, rng), rng)
    return json.dumps(document).encode()


def damage_file(path: Path, rng: random.Random, beside: Path) -> None:
    """Damage a file: what it says, its bytes, or what stands in its place."""
    way = rng.random()
    if way < 0.75 and path.suffix == ".json":
        path.write_bytes(damage_document(path.read_bytes(), rng))
    elif way < 0.92:
        path.write_bytes(damage_bytes(path.read_bytes(), rng))
    elif way < 0.95:
        path.write_bytes(beside.read_bytes() if beside.is_file() else b"")
    else:
        path.unlink()
        rng.choice(REPLACEMENTS)(path)


def make_huge(path: Path) -> None:
    """Put a text of 500 MB in the place of a file, which takes no room on the disk."""
    with path.open("wb") as file:
        file.write(b'"')
        file.truncate(500 * 10**6)


REPLACEMENTS: tuple[Callable[[Path], object], ...] = (
    lambda path: path.symlink_to("/dev/zero"),
    lambda path: path.symlink_to("/proc/self/environ"),
    lambda path: path.symlink_to(path),
    Path.mkdir,
    os.mkfifo,
    make_huge,
)


def read_everything(run: Path) -> tuple[int, str]:
    """Return how reading all of a run ends, as a command would end, and what is said."""
    try:
        store = RunDirectory(run)
        said = [str(len(store.records())), str(store.load_check()), str(len(store.load_keys()))]
        fits = [store.load_fit(key) for key in sorted(store.fit_keys())]
        records = store.planned()
        planned_task_files(store.load_plan())
        said += [str(fit.costs) for fit in fits if fit]
        said += [str(cell_command([record])) for record in records]
        said += [str(table(records).shape) for table in (score_table, job_table)]
    except UsageError as error:
        return 2, str(error)
    except Exception:
        return 70, traceback.format_exc()
    return 0, "\n".join(map(printable, said))


def read_commands(run: Path, other: Path, out: Path) -> list[list[str]]:
    """Return commands that read a run, and write nothing into it."""
    return [
        ["status", str(run)],
        ["export", str(run), "--to", str(out / "tables")],
        ["compare", str(run), str(other)],
        ["compare", str(run), "--models", "linear,knn"],
        ["check", str(run), "--reference", str(other)],
        ["merge", str(run), str(other), "--out", str(out / "merged")],
        ["run", *REQUEST, *MODELS, "--out", str(run), "--dry-run", "--explain"],
    ]


def draw_commands(run: Path, other: Path, out: Path) -> list[list[str]]:
    """Return commands that draw a run, or compute what is damaged again."""
    return [
        ["report", "--out", str(run)],
        ["report", str(run), str(other), "--to", str(out / "page.html")],
        ["run", *REQUEST, *MODELS, "--out", str(run)],
    ]


def call(arguments: list[str]) -> tuple[int, str]:
    """Return how a command ends, and what it says."""
    said = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    with redirect_stdout(said), redirect_stderr(said):
        try:
            mocapbench(arguments)
            code, error = 0, ""
        except SystemExit as ending:
            code, error = int(ending.code or 0), ""
        except BaseException as raised:
            code, error = 70, f"Traceback: {raised!r}"
    return code, said.buffer.getvalue().decode() + error


def make_run(folder: Path) -> Path:
    """Return a run directory with everything that one has, a check too."""
    run = folder / "run"
    call(["run", *REQUEST, *MODELS, "--out", str(run)])
    call(["check", str(run), "--reference", str(folder / "reference.csv"), "--update"])
    call(["check", str(run), "--reference", str(folder / "reference.csv")])
    return run


def damage_copy(whole: Path, run: Path, rng: random.Random) -> None:
    """Make a copy of a run, of which one file is damaged, or three are."""
    shutil.rmtree(run, ignore_errors=True)
    shutil.copytree(whole, run)
    files = sorted(path for path in run.rglob("*") if path.suffix in {".json", ".npz"})
    for chosen in rng.sample(files, rng.choice((1, 1, 1, 3))):
        damage_file(chosen, rng, rng.choice(files))


def try_damaged(whole: Path, folder: Path, number: int) -> tuple[str, int, str]:
    """Damage a copy of a run, and return what read it, how that ended, and what was said."""
    rng, run, out = random.Random(number), folder / "damaged", folder / "out"
    damage_copy(whole, run, rng)
    if number % 10:
        return "reading", *read_everything(run)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    commands = read_commands if number % 200 else draw_commands
    command = rng.choice(commands(run, whole, out))
    return command[0], *call(command)


def main(n_times: str, first: str = "0") -> int:
    """Fuzz runs, from the ``first`` seed on, and print how often each command ended how."""
    counts: Counter[tuple[str, int]] = Counter()
    slowest, defects, started = 0.0, 0, time.perf_counter()
    with TemporaryDirectory() as folder:
        whole = make_run(Path(folder))
        for number in range(int(first), int(first) + int(n_times)):
            before = time.perf_counter()
            command, code, said = try_damaged(whole, Path(folder), number)
            slowest = max(slowest, time.perf_counter() - before)
            counts[command, code] += 1
            if code not in ENDINGS or "Traceback" in said or said != printable(said):
                defects += 1
                print(f"{number}: {command} ended with {code}\n{said[-3000:]}", flush=True)
    seconds = time.perf_counter() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
    for (command, code), count in sorted(counts.items()):
        print(f"{command}, exit code {code}: {count}")
    print(f"{n_times} runs in {seconds:.0f} s, the slowest {slowest:.1f} s, at most {peak:.0f} MiB")
    print(f"{defects} defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
