"""Environments of commands: pinned packages, which are installed on request into the cache.

A file of requirements, as pip reads them, has an environment of its own for each version of Python;
commands with the same file share it. It is made beside its place, to which it moves once it is
whole: what a killed installation leaves behind looks installed to nobody, and goes with the next
start of `mocapbench models`.
"""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
import sysconfig
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from mocapbench.basics.cache import find_cache
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.temporaries import sweep, temporary_folder
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import words_of
from mocapbench.benchmark.messages import shorten_text

__all__ = [
    "find_environment",
    "find_environments",
    "install_environment",
    "list_variables",
    "read_versions",
    "sweep_environments",
]

_VERSIONS = "versions.txt"
"""The file of an environment with the versions of all that is installed in it."""
_NEWS = re.compile(r"(Collecting|Downloading|Using cached|Building|Installing)\b")
"""How lines of pip begin that say how far it is."""
_LINES, _WIDTH = 3, 100
"""Of what pip says, how many lines are shown at last, and how many characters of one meanwhile."""
_ADVICE = {
    r"No space left on device|Disk quota exceeded": "make room there, or name another folder in "
    "the variable MOCAPBENCH_CACHE",
    r"(?i)connection (?:error|broken)|ConnectionError|Timeout|MaxRetryError|ProxyError|resolution|"
    r"unreachable|SSLError": "check that this machine reaches the package index, and try again",
    r"Not a directory|Permission denied|Read-only file system": "name a folder that can be written "
    "to in the variable MOCAPBENCH_CACHE",
    r"ensurepip": "install what this Python lacks, on Debian the package python3-venv",
    r"": "check the packages that it lists, and that they exist for this version of Python",
}
"""What to do about a failure, by a pattern of what is said of it; the first one that is found."""
_INSTALL = ("install", "--progress-bar", "off", "--retries", "2")
_MADE = "made"
"""The name of an environment until it is whole."""
_TEMPORARY = ("TMPDIR", "TEMP", "TMP")
"""The variables by which systems name the folder of temporary files."""
_PROGRAMS = Path(sysconfig.get_path("scripts", "venv", {"base": "."})).name
"""The folder of an environment with its programs: bin, or on Windows Scripts."""


def find_environments() -> Path:
    """Return the folder of all environments."""
    return find_cache() / "environments"


def find_environment(requirements: Path) -> Path:
    """Return where the environment of a file of requirements is, or would be."""
    python = "{}.{}".format(*sys.version_info)
    digest = hashlib.sha256(python.encode() + requirements.read_bytes()).hexdigest()
    return find_environments() / f"{requirements.stem}-{digest[:12]}"


def read_versions(environment: Path) -> str:
    """Return the versions of the packages of an environment, one a line.

    Raises
    ------
    FileNotFoundError
        If it is not installed.
    """
    return (environment / _VERSIONS).read_text(encoding="utf-8")


def list_variables(environment: Path) -> Mapping[str, str]:
    """Return the variables with which ``python`` is that of an environment, which stays as it is.

    Packages of the Python that runs mocapbench are not seen there.
    """
    paths = (str(environment / _PROGRAMS), os.environ.get("PATH", os.defpath))
    return {
        "PATH": os.pathsep.join(paths),
        "VIRTUAL_ENV": str(environment),
        "PYTHONPATH": "",
        "PYTHONDONTWRITEBYTECODE": "1",
    }


def sweep_environments() -> None:
    """Delete what killed installations left behind."""
    sweep(find_environments())


def install_environment(requirements: Path, tell: Callable[[str], object]) -> Path:
    """Install the packages of a file of requirements, and return the environment.

    One that is there is left as it is.

    Parameters
    ----------
    requirements : Path
    tell : callable
        Is given how far it is, now and then.

    Raises
    ------
    UsageError
        If it cannot be done: nothing is left of it then.
    """
    environment = find_environment(requirements)
    _require_packages(requirements)
    try:
        sweep_environments()
        environment.parent.mkdir(parents=True, exist_ok=True)
        with temporary_folder(environment.parent) as folder:
            if not environment.exists():
                _make_environment(folder, requirements, tell)
                _name_interpreter(folder / _MADE, environment)
            if not environment.exists():  # another process may have been faster
                (folder / _MADE).rename(environment)
    except OSError as error:
        raise _explain_failure(requirements, [words_of(error)]) from error
    return environment


def _make_environment(folder: Path, requirements: Path, tell: Callable[[str], object]) -> None:
    """Make an environment in a folder, which also has what is only needed meanwhile.

    Raises
    ------
    UsageError
        If Python or pip fails.
    """
    made = folder / _MADE
    pip = (
        str(made / _PROGRAMS / "python"),
        "-m",
        "pip",
        "--disable-pip-version-check",
        "--retries",
        "2",
    )
    tell("making a virtual environment")
    for words in (
        (sys.executable, "-m", "venv", str(made)),
        (*pip, *_INSTALL, "--requirement", str(requirements)),
        (*pip, "list", "--format", "freeze"),
    ):
        code, lines = _call(words, folder, tell)
        if code:
            raise _explain_failure(requirements, lines)
    versions = [line for line in lines if "==" in line]
    (made / _VERSIONS).write_text("\n".join(versions) + "\n", encoding="utf-8")


def _require_packages(requirements: Path) -> None:
    """Refuse options, such as other files, whose changes nothing would tell."""
    lines = requirements.read_text(encoding="utf-8").splitlines()
    if options := [line for line in lines if line.lstrip().startswith("-")]:
        raise UsageError(
            f"{requirements}: expected packages, one a line, got {options[0].strip()!r}; list the "
            "packages themselves"
        )


def _name_interpreter(made: Path, environment: Path) -> None:
    """Have scripts name the interpreter by its place, to which it will move."""
    for script in (made / _PROGRAMS).iterdir():
        if script.is_file() and not script.is_symlink():
            content = script.read_bytes()
            script.write_bytes(content.replace(os.fsencode(made), os.fsencode(environment)))


def _call(
    words: Sequence[str], folder: Path, tell: Callable[[str], object]
) -> tuple[int, list[str]]:
    """Return the exit code of a program and the lines that it wrote; its news are told."""
    lines = []
    with find_system().run_program(
        words,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        env={**os.environ, **dict.fromkeys(_TEMPORARY, str(folder)), "PYTHONPATH": ""},
    ) as process:
        assert process.stdout is not None
        for line in map(str.strip, process.stdout):
            lines.append(line)
            if _NEWS.match(line):
                tell(shorten_text(line.partition(" (from ")[0], _WIDTH))
        process.wait()
    return process.returncode, lines


def _explain_failure(requirements: Path, lines: Sequence[str]) -> UsageError:
    """Return the error of an installation that failed, given what was said of it."""
    said = "\n".join(lines)
    last = [line for line in lines if line.startswith("ERROR: ")] or lines
    got = " | ".join(last[-_LINES:])
    advice = next(text for pattern, text in _ADVICE.items() if re.search(pattern, said))
    return UsageError(
        f"{requirements.stem}: expected to install {requirements}, got: {got}; {advice}; nothing "
        "was installed"
    )
