"""Document what packages offer by name as it is documented where it is defined.

A package loads its names at first use, from the modules that its stub lists. For constants and
types, whose text stands below them in those modules, and for metrics, whose text is that of the
function that they call, autodoc has to be told where to look.
"""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
from enum import Enum
from pathlib import Path
from typing import Any

from docutils.nodes import Element
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.pycode import ModuleAnalyzer

from mocapbench.metrics import Metric

__all__ = ["defining_modules", "documented", "offered", "setup"]

PACKAGES = ("datasets", "metrics", "baselines", "reports", "benchmark")
BEFORE_NUMPYDOC = BEFORE_AUTOSUMMARY = 400


def setup(app: Sphinx) -> dict[str, bool]:
    """Have autodoc ask here for the text of what is neither a class nor a function."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("builder-inited", _forget, priority=BEFORE_AUTOSUMMARY)
    app.connect("autodoc-process-docstring", _complete, priority=BEFORE_NUMPYDOC)
    app.connect("autodoc-process-signature", _leave_out, priority=BEFORE_NUMPYDOC)
    app.connect("autodoc-skip-member", _is_foreign)
    app.connect("missing-reference", _in_other_package)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def offered() -> dict[str, tuple[str, ...]]:
    """Return the names that each package offers."""
    packages = ["mocapbench", *(f"mocapbench.{name}" for name in PACKAGES)]
    return {package: tuple(defining_modules(package)) for package in packages}


@functools.cache
def defining_modules(package: str) -> dict[str, str]:
    """Return the module that defines each name which a package offers, by its stub."""
    stub = Path(str(importlib.import_module(package).__file__)).with_suffix(".pyi")
    return {
        alias.name: f"{package}.{statement.module}"
        for statement in ast.parse(stub.read_text(encoding="utf-8")).body
        if isinstance(statement, ast.ImportFrom) and statement.module
        for alias in statement.names
    }


def documented(full_name: str, value: Any) -> list[str]:
    """Return the lines that document a constant, a type or a metric."""
    package, _, name = full_name.rpartition(".")
    if isinstance(value, Metric):
        return inspect.cleandoc(value.__doc__ or "").splitlines()
    analyzer = ModuleAnalyzer.for_module(defining_modules(package)[name])
    return analyzer.find_attr_docs().get(("", name), [])


def _forget(app: Sphinx) -> None:
    """Remove pages of an earlier build, some of whose names may be gone."""
    for page in Path(app.srcdir, "api", "generated").glob("*.rst"):
        page.unlink()


def _complete(
    _app: Sphinx, what: str, name: str, value: Any, _options: object, lines: list[str]
) -> None:
    if what == "data":
        lines[:] = documented(name, value)
    elif inspect.isclass(value) and issubclass(value, Enum):
        values = ", ".join(f"``{member.name}`` ({member.value!r})" for member in value)
        lines += ["", f"Members: {values}."]


def _leave_out(
    _app: Sphinx, _what: str, _name: str, _value: Any, _options: object, args: str | None, _: object
) -> tuple[None, str] | None:
    """Keep numpydoc from looking for a signature where autodoc found that there is none."""
    return (None, "") if args is None else None


def _is_foreign(
    _app: Sphinx, _what: str, _name: str, member: Any, _skip: bool, _options: object
) -> bool | None:
    """Leave out what models have from scikit-learn, and fields that have only a number."""
    from_sklearn = str(getattr(member, "__module__", "")).startswith("sklearn.")
    numbered = (inspect.getdoc(member) or "").startswith("Alias for field number")
    return from_sklearn or numbered or None


def _in_other_package(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, content: Element
) -> Element | None:
    """Find a name that another package than the one at hand offers, such as `Recording`."""
    name, _, member = node["reftarget"].partition(".")
    for package, names in offered().items():
        if name in names and node.get("refdomain") == "py":
            target = ".".join(filter(None, (package, name, member)))
            domain, builder = env.domains.python_domain, app.builder
            return domain.resolve_xref(env, node["refdoc"], builder, "obj", target, node, content)
    return None
