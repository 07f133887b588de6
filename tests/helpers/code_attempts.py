"""How each command of a block of `sh` is tried; `code_shell` has the list."""

import contextlib
import io
import re
import shlex
import tomllib
from pathlib import Path

from distributed.cli import dask_scheduler, dask_worker
from packaging.requirements import Requirement
from typer.core import TyperGroup
from typer.main import get_command

from mocapbench.benchmark.cli.commands import app
from mocapbench.benchmark.cli.main import main
from mocapbench.benchmark.registry import REGISTRIES

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
EXTRAS = PYPROJECT["project"]["optional-dependencies"]
MARKS = {line.partition(":")[0] for line in PYPROJECT["tool"]["pytest"]["ini_options"]["markers"]}
NETWORK = {("data", "fetch"), ("models", "install")}
TO_INSTALL = {"transformer", "saits", "brits", "csdi", "disk"}  # networks, which tests are without
GOOD = {"check": {0, 5}}  # in a small run, controls are undecided
NARROWING = {"--tasks", "--cases", "--task-file"}
BENCHMARKING = {"--benchmark-enable", "--benchmark-only"}
PUBLISHING = {"tag", "push", "upload"}
DASK = {"scheduler": dask_scheduler.main, "worker": dask_worker.main}


def split_words(words, separator):
    """Yield the words between separators."""
    command = []
    for word in [*words, separator]:
        if word != separator:
            command.append(word)
        elif command:
            yield command
            command = []


def run_mocapbench(words):
    """Run the command line in this process; return its exit code and what it prints."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    added = [dict(registry._added) for registry in REGISTRIES]
    code = None
    with contextlib.redirect_stdout(stream), contextlib.redirect_stderr(stream):
        try:
            main(words)
        except SystemExit as ended:
            code = ended.code
    for registry, before in zip(REGISTRIES, added, strict=True):
        registry._added = before  # as in a new process
    stream.seek(0)
    return int(code or 0), stream.read()


def _attempt_mocapbench(shell, words):
    del shell
    if words[0].startswith("-"):  # these change the user's shell
        return _require_option(words)
    named = {name for word in words for name in word.split(",")}
    if tuple(words[:2]) in NETWORK or named & TO_INSTALL:
        return parse(words)
    code, printed = run_mocapbench([*words, *_lessened(words)])
    assert code in GOOD.get(words[0], {0}), (
        f"`mocapbench {shlex.join(words)}` ended with {code}:\n{printed}"
    )
    return None


def _lessened(words):
    """Return the options with which a command takes little time."""
    named = {word.partition("=")[0] for word in words}
    if words[0] == "run":
        fewer = [] if named & NARROWING else ["--tasks=toy-interpolation-1"]
        return ["--dry-run", *fewer, *([] if "--task-file" in named else ["--folds=1"])]
    return ["--model=linear"] if words[0] == "fill" and "--model" not in named else []


def _require_option(words):
    known = [name for parameter in get_command(app).params for name in parameter.opts]
    assert set(words) <= set(known), f"unknown options: {words}"


def parse(words):
    """Parse a command of ours without running it; an unknown option is an error."""
    context = get_command(app).make_context("mocapbench", list(words))
    while isinstance(context.command, TyperGroup):
        rest = [*context._protected_args, *context.args]
        name, command, rest = context.command.resolve_command(context, rest)
        context = command.make_context(name, rest, parent=context)


def _attempt_pip(shell, words):
    del shell
    assert words[0] == "install", words
    for word in words[1:]:
        if word not in {"-e", "--upgrade", "--quiet"}:
            _require_extras(word)


def _require_extras(word):
    """Fail if ``word`` is no requirement, or asks for an extra that we do not have."""
    wanted = Requirement(re.sub(r"^\.(?=\[|$)", "mocapbench", word))
    unknown = wanted.extras - set(EXTRAS) if wanted.name == "mocapbench" else set()
    assert not unknown, f"unknown extras: {unknown}"


def _attempt_tox(shell, words):
    options, _, arguments = shlex.join(words).partition(" -- ")
    run, flag, names = shlex.split(options)
    assert (run, flag) == ("run", "-e"), words
    known = set(re.findall(r"[\w.]+", " ".join(_environments(shell.tox_file().read_text()))))
    assert set(names.split(",")) <= known, f"unknown environments: {names}"
    if names == "bench":
        parse(["run", *shlex.split(arguments)])


def _environments(text):
    return [
        *re.findall(r"^\[testenv:(.*)\]", text, re.M),
        *re.findall(r"^env_list = (.*)", text, re.M),
    ]


def _attempt_python(shell, words):
    del shell
    if words[:2] != ["-m", "venv"]:
        assert Path(words[0]).is_file() or (ROOT / words[0]).is_file(), f"no file {words[0]}"


def _attempt_pytest(shell, words):
    """Folders are there, and marks are declared."""
    del shell
    if words[0] == "-m":
        assert words[1].removeprefix("not ") in MARKS, f"unknown mark: {words[1]}"
    else:
        assert all((ROOT / word).exists() for word in set(words) - BENCHMARKING), words


def _attempt_cat(shell, words):
    """The files are there; what they are added to is the workflow's."""
    del shell
    assert all(Path(word).is_file() for word in next(split_words(words, ">>"))), words


def _attempt_publishing(shell, words):
    del shell
    assert words[0] in PUBLISHING, f"none of {sorted(PUBLISHING)}: {words}"


def _attempt_dask(shell, words):
    del shell
    DASK[words[0]].make_context(words[0], words[1:], ignore_unknown_options=False)


def _attempt_runner(shell, words):
    """Our program is named, and understands what follows."""
    del shell
    name, *rest = words[words[0] == "run" :]
    assert name in PYPROJECT["project"]["scripts"], words
    parse(rest)


def _attempt_docker(shell, words):
    """What is built has a Dockerfile, and what is run understands the words after its name."""
    del shell
    name = PYPROJECT["project"]["name"]
    if words[0] == "build":
        assert words[-1] == "." and (ROOT / "Dockerfile").is_file(), words
    else:
        parse(words[words.index(name) + 1 :] or ["run"])


ATTEMPTS = {
    "mocapbench": _attempt_mocapbench,
    "pip": _attempt_pip,
    "tox": _attempt_tox,
    "python": _attempt_python,
    "pytest": _attempt_pytest,
    "dask": _attempt_dask,
    "cat": _attempt_cat,
    "git": _attempt_publishing,
    "twine": _attempt_publishing,
    "pipx": _attempt_runner,
    "uvx": _attempt_runner,
    "docker": _attempt_docker,
}
