"""What every command keeps to, however its outputs and its time end.

No ending but that of `check` is 1, which says that a metric got worse.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
from own_files import write_csv
from sessions import list_session

from mocapbench.benchmark.cli.commands import COMMANDS
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.errors import ExitCode

pytestmark = pytest.mark.slow

SCRIPT = "from mocapbench.benchmark.cli.main import main; main()"
SMOKE = ("run", "--profile", "smoke", "--tasks", "toy-interpolation-1", "--offline")
FAST = (*SMOKE, "--models", "trivial,linear", "--folds", "5", "--jobs", "1")
GIVEN = {
    "run": (*FAST, "--out", "run"),
    "fill": ("fill", "walk.csv", "--model", "linear", "--out", "{new}"),
    "init": ("init", "{new}.toml", "--recordings", "walks"),
    "status": ("status", "run"),
    "merge": ("merge", "run", "other", "--out", "{new}"),
    "report": ("report", "--out", "run"),
    "motion": ("motion", "--help"),
    "check-model": ("check-model", "--help"),
    "models": ("models", "list"),
    "check": ("check", "run", "--reference", "reference.csv"),
    "compare": ("compare", "run", "--models", "trivial,linear"),
    "power": ("power", "run"),
    "data": ("data", "status", "35_03"),
    "export": ("export", "run", "--to", "{new}"),
    "submit": ("submit", "run", "--by", "us", "--to", "{new}.zip"),
    "leaderboard": ("leaderboard", "submission.zip", "--out", "{new}"),
    "figures": ("figures", "run", "--kinds", "error-bars", "--to", "{new}"),
    "list": ("list", "models"),
    "inspect": ("inspect", "walk.csv"),
    "info": ("info",),
    "help": ("--help",),
    "version": ("--version",),
    "wrong option": ("list", "--nonsense"),
}
"""Each command, given such that it prints something and ends well."""
AT_ONCE = ("init", "motion", "check-model", "models", "list", "info")
AT_ONCE = (*AT_ONCE, "help", "version", "wrong option")
"""Those that take a second or less."""
every_command = pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(arguments, marks=[] if name in AT_ONCE else pytest.mark.slow, id=name)
        for name, arguments in GIVEN.items()
    ],
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with all that the commands need."""
    folder = tmp_path_factory.mktemp("endings")
    write_csv(folder / "walk.csv", gaps=[(20, 26, 0)])
    for name in ("a", "b"):
        write_csv(folder / "walks" / f"{name}.csv")
    other = [word.replace("interpolation-1", "interpolation-2") for word in FAST]
    check = ("check", "run", "--reference", "reference.csv", "--update")
    submit = ("submit", "run", "--by", "us")
    for arguments in (GIVEN["run"], (*other, "--out", "other"), check, submit):
        with _started(arguments, folder, stdout=subprocess.DEVNULL) as process:
            assert process.wait() == 0
    return folder


def _started(arguments, folder, before="", closing="", **options):
    """Start a command, after some code; ``{new}`` is a path where nothing is yet."""
    words = [word.format(new=f"new-{time.monotonic_ns()}") for word in map(str, arguments)]
    command = [sys.executable, "-c", before + SCRIPT, *words]
    (folder / "tmp").mkdir(exist_ok=True)
    return subprocess.Popen(
        ["sh", "-c", f'exec "$@" {closing}', "sh", *command],
        cwd=folder,
        env={**os.environ, "TMPDIR": str(folder / "tmp"), "OPENBLAS_NUM_THREADS": "1"},
        text=True,
        start_new_session=True,
        **options,
    )


def _ended(arguments, folder, **options):
    """Return the exit code of a command, and what it said; it left nothing behind."""
    outputs = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with _started(arguments, folder, **(outputs | options)) as process:
        said = "".join(filter(None, process.communicate(timeout=120)))
    assert "Traceback" not in said
    assert "Exception ignored" not in said
    _require_nothing_left(process, folder)
    return process.returncode, said


def _require_nothing_left(process, folder):
    psutil.wait_procs(list_session(process), timeout=30)
    assert not list_session(process)
    assert not [*(folder / "tmp").iterdir()]
    assert not [path for path in folder.rglob(".*") if path.name != ".lock"]


def test_every_command_is_given():
    assert COMMANDS.keys() <= GIVEN.keys()


@every_command
def test_a_reader_that_leaves_ends_a_command_with_141(folder, arguments):
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write) as pipe:
        outputs = {"stdout": pipe, "stderr": pipe}
        assert _ended(arguments, folder, **outputs)[0] == ExitCode.CLOSED_PIPE


@every_command
def test_a_full_disk_is_said_and_is_not_a_metric_that_got_worse(folder, arguments):
    with Path("/dev/full").open("w") as full:
        code, said = _ended(arguments, folder, stdout=full)
    assert code == ExitCode.USAGE
    if "--nonsense" not in arguments:  # which is said on standard error alone
        assert said.count("cannot write to standard output: No space left on device") == 1


@every_command
def test_streams_may_be_closed(folder, arguments):
    code, _ = _ended(arguments, folder, closing="<&- >&- 2>&-")
    assert code == (ExitCode.USAGE if "--nonsense" in arguments else ExitCode.OK)


NARROW = """
import sys
for stream in (sys.stdout, sys.stderr):
    stream.reconfigure(encoding="cp1252", errors="strict")
"""


@every_command
def test_what_a_console_of_windows_cannot_show_ends_no_command(folder, arguments):
    code, _ = _ended(arguments, folder, before=NARROW, errors="replace")
    assert code == (ExitCode.USAGE if "--nonsense" in arguments else ExitCode.OK)


STRIKING = """
import io, os, sys
class Striking(io.TextIOWrapper):
    def write(self, text):
        os.kill(os.getpid(), {number})
        return super().write(text)
sys.stdout = Striking(sys.stdout.buffer)
sys.stderr = Striking(sys.stderr.buffer)
"""


@every_command
def test_a_command_that_is_told_to_end_ends_with_143(folder, arguments):
    before = STRIKING.format(number=int(signal.SIGTERM))
    assert _ended(arguments, folder, before=before)[0] == ExitCode.TERMINATED


ENDINGS = {
    signal.SIGHUP: ExitCode.HUNG_UP,
    signal.SIGINT: ExitCode.INTERRUPTED,
    signal.SIGTERM: ExitCode.TERMINATED,
}
each_signal = pytest.mark.parametrize(("number", "code"), ENDINGS.items(), ids=str)

SLEEPER = """
import os, pathlib, time
from mocapbench.baselines import LinearImputer
class Sleeper(LinearImputer):
    def impute(self, *arguments, **options):
        pathlib.Path("asleep").touch()
        time.sleep(600)
MODELS = {"sleeper": Sleeper}
"""


@each_signal
def test_a_fill_that_is_ended_leaves_no_file_and_no_process(folder, number, code):
    (folder / "sleeper.py").write_text(SLEEPER)
    (folder / "asleep").unlink(missing_ok=True)
    chosen = ("--plugin", "sleeper.py", "--model", "sleeper", "--out", "never")
    outputs = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with _started(("fill", "walk.csv", *chosen), folder, **outputs) as process:
        while not (folder / "asleep").exists():
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(number)
        said = "".join(process.communicate(timeout=60))
    assert process.returncode == code
    assert said == "interrupted; files that were filled are kept, others were not written\n"
    assert not (folder / "never").exists()
    _require_nothing_left(process, folder)


PLUGIN = """
import {}
from mocapbench.baselines import LinearImputer
MODELS = {{"mine": LinearImputer}}
"""
SWALLOWING = """
import os
try:
    os.kill(os.getpid(), {number})
    sum(range(100))
except BaseException:
    pass
"""


@each_signal
def test_a_signal_within_an_import_that_swallows_it_ends_the_command(folder, number, code):
    (folder / "swallowing.py").write_text(SWALLOWING.format(number=int(number)))
    (folder / "plugin.py").write_text(PLUGIN.format("swallowing"))
    ended, said = _ended(("list", "models", "--plugin", "plugin.py"), folder)
    assert (ended, said) == (code, "")


def test_an_import_that_does_not_end_is_interrupted_by_the_second_signal(folder):
    (folder / "endless.py").write_text("import time\nprint(1, flush=True)\ntime.sleep(600)\n")
    (folder / "plugin.py").write_text(PLUGIN.format("endless"))
    with _started(
        ("list", "models", "--plugin", "plugin.py"), folder, stdout=subprocess.PIPE
    ) as process:
        process.stdout.readline()
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=3) == ExitCode.INTERRUPTED


@pytest.mark.parametrize(
    ("error", "code"), [(BrokenPipeError(32, "Broken pipe"), 2), (EOFError("end"), 70)], ids=str
)
def test_an_end_of_data_elsewhere_is_not_taken_for_a_closed_terminal(monkeypatch, error, code):
    def fail(*_):
        raise error

    monkeypatch.setattr("mocapbench.benchmark.TASKS.names", fail)
    with pytest.raises(SystemExit) as ended:
        main(["list", "tasks"])
    assert ended.value.code == code


def test_signals_are_handled_as_before_once_a_command_has_ended():
    before = [signal.getsignal(number) for number in (*ENDINGS, signal.SIGALRM)]
    with pytest.raises(SystemExit):
        main(["--version"])
    assert [signal.getsignal(number) for number in (*ENDINGS, signal.SIGALRM)] == before
