"""No name and no message reaches a terminal as anything but text."""

import ast
import importlib
import re
import unicodedata
import warnings
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from plans import plan_of
from rich.progress import Progress
from rich.table import Table
from rich.text import Text

from mocapbench import benchmark
from mocapbench.benchmark import gate
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.datasets import TextColumnsWarning

CLEAR, LINK = "\x1b[2J", "\x1b]8;;http://elsewhere\x1b\\"
SHOWN = ":bomb:[/x][link=http://elsewhere]here[/link]"
HOSTILE = f"{CLEAR}{LINK}\x9b2J\u202e\x07{SHOWN}"
OURS = re.compile(r"\x1b\[(?:[\d;]*m|2K|1A|\?25[lh])|\r")
"""Styles, and what moves a progress bar: what we write to a terminal ourselves."""
ABOUT = {
    **{"profile": "smoke", "seed": "0", "machine": HOSTILE, "libc": "l", "BLAS": "b"},
    **dict.fromkeys(("numpy version", "scipy version", "scikit-learn version"), "1"),
}


def obeyed(text):
    """Return the characters that a terminal would obey."""
    rest = OURS.sub("", text)
    return {c for c in rest if unicodedata.category(c) == "Cc" and c != "\n"} | {
        c for c in rest if c in "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
    }


def table_of(text):
    table = Table(text, title=text, caption=text)
    table.add_row(text)
    return table


@pytest.fixture(params=[False, True], ids=["file", "terminal"])
def terminal(request, monkeypatch):
    """Write to a file, and to a terminal that knows colours."""
    monkeypatch.setenv("COLUMNS", "300")
    if request.param:
        monkeypatch.setenv("FORCE_COLOR", "1")


@pytest.fixture
def printed(terminal, capsys):
    """Return a function that runs the command line and returns what it wrote, as it wrote it."""

    def printed(*arguments):
        capsys.readouterr()
        with pytest.raises(SystemExit):
            main([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return captured.out + captured.err

    return printed


def _record(key, case, label, fold, status):
    scores = {"mse": 1.0 + fold} if status is Status.OK else {}
    return Record(
        key=key,
        fit_key="fit",
        address=Address("toy-interpolation-1", 1, case, fold, label),
        seed=0,
        model=label,
        parameters={HOSTILE: HOSTILE},
        status=status,
        message=HOSTILE,
        traceback=HOSTILE,
        scores=scores,
        provenance=ABOUT,
    )


@pytest.fixture
def run(tmp_path):
    """Return a run directory whose names and messages are hostile, its own included."""
    store = RunDirectory.create(tmp_path / HOSTILE.replace("/", ""))
    cases = {"test 1": Status.OK, "test 2": Status.FAILED}
    labels = ("knn", HOSTILE)
    jobs = [*product(cases, labels, (0, 1))]
    found = [_record(f"{n}", *job, cases[job[0]]) for n, job in enumerate(jobs)]
    for record in found:
        store.save(record)
    store.save_plan(plan_of(found, **ABOUT))
    (store.path / "records" / f"{found[0].key}.json").write_text(CLEAR)
    return store.path


@given(st.text() | st.text("\x1b[]8;\x07\\m\x9b\u202e a/:b\r\n"))
def test_whatever_is_printed_is_text(text):
    console = LiteralConsole()
    with console.capture() as captured:
        console.print(text, Text(text), style="bold")
        console.print(table_of(text))
    assert not obeyed(captured.get())


def test_lines_and_brackets_of_a_message_stay(capsys):
    LiteralConsole(stderr=True).print(f"one\ntwo {HOSTILE}", soft_wrap=True)
    assert capsys.readouterr().err == f"one\ntwo {SHOWN}\n"


def test_a_table_keeps_no_room_for_what_is_left_out(capsys):
    LiteralConsole().print(table_of(LINK + "name"))
    *_, head, _, row, _, _ = capsys.readouterr().out.splitlines()
    assert (head, row) == ("┃ name ┃", "│ name │")


def test_a_link_is_shown_as_text(terminal, capsys):
    console = LiteralConsole()
    console.print(Text.from_ansi(f"{LINK}here{LINK}"), Text("there", "link http://elsewhere"))
    assert OURS.sub("", capsys.readouterr().out) == "here there\n"


def test_what_is_written_beside_a_bar_is_text(monkeypatch, capsys):
    monkeypatch.setenv("FORCE_COLOR", "1")
    with Progress(console=LiteralConsole()):
        print(HOSTILE)
    assert not obeyed(capsys.readouterr().out)


@pytest.mark.parametrize(
    "arguments",
    [
        ("export", "{run}"),
        ("report", "--out", "{run}"),
        ("check", "{run}", "--reference", "{run}.csv"),
        ("check", "{run}", "--controls"),
        ("compare", "{run}", "{run}"),
        ("compare", "{run}", "--models", f"knn,{HOSTILE}"),
        ("compare", "{run}", "--models", f"no,{CLEAR}"),
        ("power", "{run}"),
        ("power", "{run}", "--models", f"no,{CLEAR}"),
        ("export", HOSTILE),
        ("run", "--tasks", HOSTILE),
        ("data", "status", HOSTILE),
        ("list", "models", "--plugin", HOSTILE),
    ],
    ids=lambda arguments: ascii(" ".join(arguments))[1:30],
)
def test_of_hostile_names_and_messages_every_command_shows_the_text(printed, run, arguments):
    printed("check", run, "--reference", f"{run}.csv", "--update", "--allow-failures")
    text = printed(*(argument.format(run=run) for argument in arguments))
    assert text
    assert not obeyed(text)
    assert "Traceback" not in text


def test_the_text_itself_is_shown(printed, run):
    text = printed("check", run, "--reference", f"{run}.csv", "--update", "--allow-failures")
    assert SHOWN.replace("/", "") in OURS.sub("", text).replace("/", "")


@pytest.mark.slow
def test_of_hostile_models_a_run_shows_the_text(printed, tmp_path):
    plugin = tmp_path / "plugin.py"
    plugin.write_text(
        "from mocapbench.baselines import CubicSplineImputer\n"
        f"HOSTILE = {HOSTILE!r}\n"
        "class Raises(CubicSplineImputer):\n"
        "    def fit(self, recordings):\n"
        "        raise ValueError(HOSTILE)\n"
        "MODELS = {'raises': Raises}\n"
    )
    options = ("--plugin", plugin, "--offline", "--profile", "smoke", "--folds", 1)
    chosen = ("--tasks", "toy-interpolation-1", "--models", "raises")
    text = printed("run", *options, *chosen, "--out", tmp_path / "run")
    assert SHOWN in OURS.sub("", text)
    assert "1 failed" in OURS.sub("", text)
    assert not obeyed(text)
    for shown in (printed("list", "models", "--plugin", plugin), printed("info")):
        assert not obeyed(shown)


def test_a_traceback_is_text(printed, run, monkeypatch):
    def fail(path):
        raise ZeroDivisionError(HOSTILE)

    monkeypatch.setattr(gate, "read_reference", fail)
    text = printed("check", run, "--reference", "b.csv")
    assert f"ZeroDivisionError: {SHOWN}\n" in OURS.sub("", text)
    assert not obeyed(text)


def test_a_warning_is_text(printed, run, monkeypatch):
    before = warnings.showwarning

    def warn(path):
        warnings.warn(HOSTILE, UserWarning, stacklevel=1)

    monkeypatch.setattr(gate, "read_reference", warn)
    text = printed("check", run, "--reference", "b.csv")
    assert f"UserWarning: {SHOWN}\n" in text
    assert not obeyed(text)
    assert warnings.showwarning is before


def test_a_warning_is_shown_once_whatever_becomes_of_the_filters(printed, run, monkeypatch):
    def warn(path):
        for text in ("one", "two", "one"):
            warnings.simplefilter("always")
            warnings.warn(f"{text} column", TextColumnsWarning, stacklevel=1)

    monkeypatch.setattr(gate, "read_reference", warn)
    text = printed("check", run, "--reference", "b.csv")
    assert [text.count(f"{each} column") for each in ("one", "two")] == [1, 1]


def calls(path):
    """Return the names of what a module calls."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = (node.func for node in ast.walk(tree) if isinstance(node, ast.Call))
    return {function.id for function in functions if isinstance(function, ast.Name)}


def test_no_other_way_leads_to_the_terminal():
    modules = [*Path(benchmark.__path__[0]).rglob("*.py")]
    assert importlib.import_module("mocapbench.benchmark.cli.console").__file__ in map(str, modules)
    assert not [path for path in modules if calls(path) & {"print", "Console"}]
