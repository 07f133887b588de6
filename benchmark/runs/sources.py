"""Digests of source code: of what a function or class computes with, and of no prose.

The digest of a module covers its syntax tree and that of everything it imports, directly or not,
from its own package and from packages named. Comments, docstrings and layout are no part of a
syntax tree without docstrings; and a module is not followed for a `TaskPage`, which changes no
result.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.util import decode_source
from pathlib import Path
from types import FunctionType, ModuleType
from typing import NamedTuple

from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["source_digest"]

_OURS = "mocapbench"
_COMPILED = {*EXTENSION_SUFFIXES, ".so", ".pyd"}


@cache
def source_digest(module: str, within: tuple[str, ...]) -> str:
    """Return the digest of a module's code and of the code that it imports.

    Imports are followed to the module that defines the imported name, so that a package's
    ``__init__`` does not bring in all that it offers; a package that is imported whole does.
    Compiled code counts by its bytes.

    Parameters
    ----------
    module : str
        Full name of an imported module.
    within : tuple of str
        Packages of ours that count besides. Of another project, all modules of the same package
        count; of a single file, those in the same folder.
    """
    reached: set[str] = set()
    pending = [module]
    while pending:
        name = pending.pop()
        if name not in reached:
            reached.add(name)
            near = (item for item in _read(name).imports if _near(item.module, within, module))
            found = (_definer(item.module, item.name) for item in near)
            pending += [item for item in found if _counts(item, within, module)]
    # The first goes without its name: a user's file has no lasting one as a module.
    others = (f"\0{name}\0{_read(name).code}" for name in sorted(reached - {module}))
    message = "".join([_read(module).code, *others])
    return hashlib.sha256(message.encode()).hexdigest()


def _near(module: str, within: tuple[str, ...], root: str) -> bool:
    """Return whether it is worth looking where the names of ``module`` come from."""
    projects = {name.partition(".")[0] for name in (*within, root)}
    return module.partition(".")[0] in projects or _neighbours(module, root)


def _counts(module: str, within: tuple[str, ...], root: str) -> bool:
    if any(module == name or module.startswith(f"{name}.") for name in within):
        return True
    home = root.partition(".")[0]
    same_package = "." in root and home != _OURS and module.partition(".")[0] == home
    return same_package or _neighbours(module, root)


def _neighbours(module: str, root: str) -> bool:
    """Return whether both are single files, in one folder: the helpers of a user's own file."""
    if "." in root or "." in module:
        return False
    file, home = _file(module), _file(root)
    return file is not None and home is not None and file.parent == home.parent


class _Import(NamedTuple):
    """A module that is imported, or a name that is imported from it."""

    module: str
    name: str = ""


class _Module(NamedTuple):
    """A module's code without comments, docstrings and layout, and what it imports."""

    code: str
    imports: tuple[_Import, ...]


@cache
def _read(module: str) -> _Module:
    tree = ast.parse(_source(module))
    nodes = [*ast.walk(tree)]
    imports = tuple(dict.fromkeys(_imports(module, nodes)))
    for node in nodes:
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            node.body = [statement for statement in node.body if not _is_prose(statement)]
    return _Module(ast.unparse(tree), imports)


def _is_prose(statement: ast.stmt) -> bool:
    """Return whether a statement is a text by itself, such as a docstring: it computes nothing."""
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


def _source(module: str) -> str:
    """Return the text of a module; of compiled code, its digest in the place of a text."""
    file = _file(module)
    if file is None:
        return ""
    content = file.read_bytes()
    if file.suffix in _COMPILED:
        return f"compiled = {hashlib.sha256(content).hexdigest()!r}"
    return decode_source(content)


def _file(module: str) -> Path | None:
    name = getattr(_imported(module), "__file__", None)
    return Path(name) if name else None


def _imported(module: str) -> ModuleType | None:
    """Return a module; None if it is an optional part that cannot be imported here."""
    try:
        return importlib.import_module(module)
    except Exception:  # whatever such a module raises where it does not work
        return None


def _imports(module: str, nodes: Iterable[ast.AST]) -> Iterator[_Import]:
    """Yield what ``module``, of these nodes, imports, and what it offers lazily."""
    values = vars(_imported(module)) if _imported(module) else {}
    for node in (*nodes, *_stub(module)):
        if isinstance(node, ast.Import):
            yield from (_Import(alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            origin = _absolute(node, module)
            yield from (
                _Import(origin, alias.name)
                for alias in node.names
                if not isinstance(values.get(alias.asname or alias.name), TaskPage)
            )


@cache
def _definer(module: str, name: str) -> str:
    """Return the module that ``name`` comes from, if ``module`` is a package that passes it on."""
    passed = _Import(module, name)
    visited: set[_Import] = set()
    while passed not in visited:
        visited.add(passed)
        passed = _passed_on(passed.module).get(passed.name, passed)
    module, name = passed
    if not (name and _is_package(module)):
        return module
    if _imported(f"{module}.{name}"):
        return f"{module}.{name}"
    value = getattr(_imported(module), name, None)  # perhaps made by the package's __getattr__
    return value.__module__ if isinstance(value, type | FunctionType) else module


@cache
def _passed_on(package: str) -> Mapping[str, _Import]:
    """Return what a package offers of its modules, by name, and where it takes it from."""
    if not _is_package(package):
        return {}
    nodes = (*ast.walk(ast.parse(_source(package))), *_stub(package))
    return {
        alias.asname or alias.name: _Import(_absolute(node, package), alias.name)
        for node in nodes
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


@cache
def _stub(package: str) -> tuple[ast.stmt, ...]:
    """Return the stub of a package that loads what it offers when asked for it."""
    file = _file(package)
    stub = file.with_suffix(".pyi") if file else None
    if stub is None or not stub.is_file():
        return ()
    return tuple(ast.parse(decode_source(stub.read_bytes())).body)


def _is_package(module: str) -> bool:
    return hasattr(_imported(module), "__path__")


def _absolute(node: ast.ImportFrom, importer: str) -> str:
    """Return the full name of what ``from … import`` names, relative imports resolved."""
    if not node.level:
        return node.module or ""
    above = node.level - _is_package(importer)
    parts = importer.split(".")
    base = parts[: len(parts) - above]
    return ".".join([*base, node.module] if node.module else base)
