"""The TOML file of a model that is a command."""

from __future__ import annotations

import hashlib
import shlex
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from mocapbench.baselines import ABILITIES, IMPLIED, FrameImputer, Interpolator
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.programs.entrants import name_plugin
from mocapbench.benchmark.programs.environments import (
    find_environment,
    list_variables,
    read_versions,
)
from mocapbench.benchmark.programs.exchange import EXCHANGES
from mocapbench.benchmark.programs.model import CommandModel
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.values import is_count, is_path, is_text, read_names

__all__ = ["define_models", "find_requirements", "is_declaration", "list_files", "read_declaration"]

_ABILITIES = ("fills frames", "fills entries", "fills new recordings", "interpolates")
"""What a command may provide."""
_NEEDS = ("coordinates",)
"""What a command may need: nothing that `fit` receives besides recordings."""
_KEYS = (
    *("name", "summary", "command", "files", "format", "provides", "needs", "learns_in_fit"),
    *("max_frames", "seeds", "environment", "licence", "source", "requirements"),
)


def is_declaration(path: Path) -> bool:
    """Return whether a plug-in is the TOML file of a command."""
    return path.suffix == ".toml"


def define_models(path: Path) -> Mapping[str, type[CommandModel]]:
    """Return the class of the model that a TOML file declares, by each name that it has.

    Where it takes part with several seeds, these are its own, and with a number after it: a seed
    follows from the name.

    Raises
    ------
    UsageError
        If the file is not as expected; the message has line and key.
    """
    document = read_declaration(path)
    document.require_known("", _KEYS)
    name: str = document.read("name", "", is_text, "a name", '"my-model"')
    command = _read_texts(document, "command", '["python3", "my_model.py"]')
    if not (name and command):
        missing = "command" if name else "name"
        raise document.error(missing, "a value", "none", 'write name = "…" and command = ["…"]')
    variables, versions = _find_packages(path)
    content = {
        "command": command,
        "folder": path.resolve().parent,
        "exchange": document.read(
            "format", "npz", EXCHANGES.__contains__, f"one of {', '.join(EXCHANGES)}", '"npz"'
        ),
        "files_digest": _digest_contents([path, *list_files(path)], versions),
        "variables": variables,
        "__doc__": _describe(document, command),
        **_read_abilities(document),
    }
    seeds: int = document.read("seeds", 1, is_count, "a number of seeds", "3")
    again = [f"{name}-{number}" for number in range(2, seeds + 1)]
    return {
        name: _register_class(name, content),
        **{other: _register_class(other, {**content, "same_as": name}) for other in again},
    }


def read_declaration(path: Path) -> Document:
    """Return what the TOML file of a command says.

    Raises
    ------
    UsageError
        If it is not there, or no text.
    """
    try:
        return Document(str(path), path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(
            f"--plugin: expected a TOML file of a command, got {str(path)!r}: {error}; check it"
        ) from error


def list_files(path: Path) -> list[Path]:
    """Return the files of a command that its TOML file lists, which stand beside or below it.

    Raises
    ------
    UsageError
        If one is not there, or stands elsewhere.
    """
    document = read_declaration(path)
    named = [("files", name) for name in _read_texts(document, "files", '["my_model.py"]')]
    if requirements := document.read("requirements", "", is_text, "a file", '"requirements.txt"'):
        named.append(("requirements", requirements))
    return [_find_beside(document, path, key, name) for key, name in named]


def find_requirements(path: Path) -> Path | None:
    """Return the file of packages that a command needs; None if its TOML file names none.

    Raises
    ------
    UsageError
        See `list_files`.
    """
    return list_files(path)[-1] if read_declaration(path).get("requirements") else None


def _find_beside(document: Document, path: Path, key: str, name: str) -> Path:
    file = path.resolve().parent / name
    if not (is_path(name) and file.is_file()):
        raise document.error(
            key, "files beside the TOML file, or below", repr(name), "correct the path"
        )
    return file


def _find_packages(path: Path) -> tuple[Mapping[str, str], str]:
    """Return the variables with which a command finds its packages, and their versions.

    Raises
    ------
    UsageError
        If it needs some that are not installed.
    """
    requirements = find_requirements(path)
    if requirements is None:
        return {}, ""
    environment = find_environment(requirements)
    try:
        return list_variables(environment), read_versions(environment)
    except FileNotFoundError as error:
        raise UsageError(
            f"{path}: expected the packages of {requirements.name} in an environment of their own, "
            f"got none; run `mocapbench models install {name_plugin(path)}`"
        ) from error


def _read_texts(document: Document, key: str, example: str) -> tuple[str, ...]:
    texts: list[str] = document.read(
        key,
        [],
        lambda value: isinstance(value, list) and bool(value) and all(map(is_text, value)),
        "a list of texts",
        example,
    )
    return tuple(texts)


def _read_abilities(document: Document) -> dict[str, Any]:
    """Return what the model can do and what it needs, as attributes of its class."""
    provides = _read_subset(document, "provides", _ABILITIES) or {"fills entries"}
    while more := {IMPLIED[name] for name in provides & IMPLIED.keys()} - provides:
        provides |= more
    return {
        "provides": frozenset(provides),
        "needs": frozenset(_read_subset(document, "needs", _NEEDS)),
        "family": (Interpolator if "interpolates" in provides else FrameImputer).family,
        "learns_in_fit": document.read(
            "learns_in_fit", False, lambda value: type(value) is bool, "true or false", "true"
        ),
        "max_frames": document.read("max_frames", None, is_count, "a number of frames", "2000"),
    }


def _read_subset(document: Document, key: str, known: tuple[str, ...]) -> set[str]:
    names = set(read_names(document, key, f'["{known[0]}"]'))
    for name in sorted(names - {*known}):
        which = "only of models in Python" if name in ABILITIES else "unknown"
        advice = f"remove it: it is {which}"
        raise document.error(key, f"some of {', '.join(known)}", repr(name), advice)
    return names


def _describe(document: Document, command: tuple[str, ...]) -> str:
    """Return the docstring of the class: a sentence with what it runs on, and a paper."""
    summary, environment, licence, source = (
        document.read(key, "", is_text, "a text", '"…"')
        for key in ("summary", "environment", "licence", "source")
    )
    facts = "; ".join(filter(None, [environment, licence]))
    sentence = (summary or f"The command {shlex.join(command)}").rstrip(".")
    paper = f"\n\nReferences\n----------\n{source}" if source else ""
    return f"{sentence}{f' ({facts})' if facts else ''}.{paper}"


def _digest_contents(paths: list[Path], versions: str) -> str:
    digest = hashlib.sha256(versions.encode())
    for path in paths:
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _register_class(name: str, content: Mapping[str, Any]) -> type[CommandModel]:
    """Return the class of a command, which pickle finds in the module of its base.

    There its name has no dots, by which pickle would look for parts of a class.
    """
    kind = cast("type[CommandModel]", type(name, (CommandModel,), dict(content)))
    kind.__module__ = CommandModel.__module__
    kind.__qualname__ = f"{CommandModel.__name__}:{name.replace('.', ':')}"
    setattr(sys.modules[kind.__module__], kind.__qualname__, kind)
    return kind
