"""Reading modules: their code without prose, what they import, and where names come from."""

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

from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["definer", "read"]

_COMPILED = {*EXTENSION_SUFFIXES, ".so", ".pyd"}


Import = tuple[str, str]
"""A module, and the name that is imported from it; empty where the module itself is."""


@cache
def read(module: str) -> tuple[str, tuple[Import, ...], tuple[Import, ...]]:
    """Return the code of a module and what it imports; of compiled code, its digest.

    Returns
    -------
    code : str
        Without comments, docstrings and layout.
    imports, used : tuple of Import
        All that it imports; and of a package, what of that it does not merely pass on.
    """
    tree = ast.parse(_source(module))
    nodes = [*ast.walk(tree)]
    imports = (*_imports(module, nodes),)
    names = {"", *(node.id for node in nodes if isinstance(node, ast.Name))}
    every = tuple(dict.fromkeys(item for _, item in imports))
    used = tuple(dict.fromkeys(item for here, item in imports if here in names))
    for node in nodes:
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            node.body = [statement for statement in node.body if not _is_prose(statement)]
    return ast.unparse(tree), every, used


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
    name = getattr(_import_optional(module), "__file__", None)
    return Path(name) if name else None


def _import_optional(module: str) -> ModuleType | None:
    """Return a module; None if it is an optional part that cannot be imported here."""
    try:
        return importlib.import_module(module)
    except Exception:  # whatever such a module raises where it does not work
        return None


def _imports(module: str, nodes: Iterable[ast.AST]) -> Iterator[tuple[str, Import]]:
    """Yield what ``module``, of these nodes, imports, and what it offers lazily.

    With each comes the name that it has here, or none if it is imported for what it does.
    """
    values = vars(_import_optional(module)) if _import_optional(module) else {}
    for node in (*nodes, *_stub(module)):
        if isinstance(node, ast.Import):
            yield from _modules(node)
        elif isinstance(node, ast.ImportFrom):
            origin = _absolute(node, module)
            for alias in node.names:
                here = alias.asname or alias.name
                if not isinstance(values.get(here), TaskPage):
                    yield here, (origin, alias.name)


def _modules(node: ast.Import) -> Iterator[tuple[str, Import]]:
    """Yield what ``import a.b`` brings in: without another name, also all that ``a`` offers."""
    for alias in node.names:
        yield "", (alias.name, "")
        if not alias.asname:
            first = alias.name.partition(".")[0]
            yield first, (first, "")


@cache
def definer(module: str, name: str) -> str:
    """Return the module that ``name`` comes from, if ``module`` is a package that passes it on."""
    passed = (module, name)
    visited: set[Import] = set()
    while passed not in visited:
        visited.add(passed)
        passed = _passed_on(passed[0]).get(passed[1], passed)
    module, name = passed
    if not (name and _is_package(module)):
        return module
    if _import_optional(f"{module}.{name}"):
        return f"{module}.{name}"
    # The package's __getattr__ may have made it.
    value = getattr(_import_optional(module), name, None)
    return value.__module__ if isinstance(value, type | FunctionType) else module


@cache
def _passed_on(package: str) -> Mapping[str, Import]:
    """Return what a package offers of its modules, by name, and where it takes it from."""
    if not _is_package(package):
        return {}
    nodes = (*ast.walk(ast.parse(_source(package))), *_stub(package))
    return {
        alias.asname or alias.name: (_absolute(node, package), alias.name)
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
    return hasattr(_import_optional(module), "__path__")


def _absolute(node: ast.ImportFrom, importer: str) -> str:
    """Return the full name of what ``from … import`` names, relative imports resolved."""
    if not node.level:
        return node.module or ""
    above = node.level - _is_package(importer)
    parts = importer.split(".")
    base = parts[: len(parts) - above]
    return ".".join([*base, node.module] if node.module else base)
