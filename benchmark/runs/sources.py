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
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType

from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["source_digest"]

_OURS = "mocapbench"


@cache
def source_digest(module: str, within: tuple[str, ...]) -> str:
    """Return the digest of a module's code and of the code that it imports.

    Imports are followed to the module that defines the imported name, so that a package's
    ``__init__`` does not bring in all that it offers.

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
            pending += [item for item in _imports(name) if _counts(item, within, module)]
    # The first goes without its name: a user's file has no lasting one as a module.
    others = (f"\0{name}\0{_code(name)}" for name in sorted(reached - {module}))
    message = "".join([_code(module), *others])
    return hashlib.sha256(message.encode()).hexdigest()


def _counts(module: str, within: tuple[str, ...], root: str) -> bool:
    if any(module == name or module.startswith(f"{name}.") for name in within):
        return True
    home = root.partition(".")[0]
    same_package = "." in root and home != _OURS and module.partition(".")[0] == home
    return same_package or _neighbours(module, root)


def _neighbours(module: str, root: str) -> bool:
    """Return whether both are single files, in one folder: the helpers of a user's own file."""
    file, home = _file(module), _file(root)
    alone = "." not in root and "." not in module
    return alone and file is not None and home is not None and file.parent == home.parent


def _file(module: str) -> Path | None:
    name = getattr(sys.modules.get(module), "__file__", None)
    return Path(name) if name else None


def _source(module: str) -> str:
    importlib.import_module(module)
    file = _file(module)
    return file.read_text(encoding="utf-8") if file else ""


def _tree(module: str) -> ast.Module:
    return ast.parse(_source(module))


def _code(module: str) -> str:
    """Return a module's code without comments, docstrings and layout."""
    tree = _tree(module)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            node.body = [statement for statement in node.body if not _is_prose(statement)]
    return ast.unparse(tree)


def _is_prose(statement: ast.stmt) -> bool:
    """Return whether a statement is a text by itself, such as a docstring: it computes nothing."""
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )


def _imports(module: str) -> Iterator[str]:
    importer = sys.modules.get(module) or importlib.import_module(module)
    for node in ast.walk(_tree(module)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = _absolute(node, importer)
            yield from (
                _definer(package, alias.name)
                for alias in node.names
                if not isinstance(vars(importer).get(alias.asname or alias.name), TaskPage)
            )


def _absolute(node: ast.ImportFrom, importer: ModuleType) -> str:
    """Return the full name of what ``from … import`` names, relative imports resolved."""
    if not node.level:
        return node.module or ""
    parts = (importer.__package__ or "").split(".")
    base = parts[: len(parts) - node.level + 1]
    return ".".join([*base, node.module] if node.module else base)


def _definer(package: str, name: str) -> str:
    """Return the module that defines ``name``, which ``package`` may only pass on."""
    if f"{package}.{name}" in sys.modules:
        return f"{package}.{name}"
    for node in _stub(package):
        if any(name == (alias.asname or alias.name) for alias in node.names):
            return f"{package}.{node.module}"
    value = getattr(sys.modules.get(package), name, None)
    return str(getattr(value, "__module__", package))


@cache
def _stub(package: str) -> tuple[ast.ImportFrom, ...]:
    """Return the imports in the stub of a package that loads what it offers when asked for it."""
    file = _file(package)
    stub = file.with_suffix(".pyi") if file else None
    if stub is None or not stub.is_file():
        return ()
    tree = ast.parse(stub.read_text(encoding="utf-8"))
    return tuple(node for node in tree.body if isinstance(node, ast.ImportFrom))
