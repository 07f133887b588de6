"""Digests of source code: of what a function or class computes with, and of no prose.

The digest of a module covers its syntax tree and that of everything it imports, directly or not,
from its own package and from packages named. Code of a user brings in all the user's code that it
imports (`own_code`), wherever that is. Comments, docstrings and layout are not part of a syntax
tree without docstrings; and a module is not followed for a `TaskPage`, which changes no result.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from functools import cache
from itertools import accumulate

from mocapbench.benchmark.runs.source_code.own_code import folders_of, is_own_code
from mocapbench.benchmark.runs.source_code.reading import definer, read

__all__ = ["source_digest"]

_OURS = "mocapbench"


@cache
def source_digest(module: str, within: tuple[str, ...]) -> str:
    """Return the digest of a module's code and of the code that it imports.

    Imports are followed to the module that defines the imported name, so that a package's
    ``__init__`` does not bring in all that it offers; a package that is imported whole does.
    Python runs the ``__init__`` of a package before its modules. Outside of our own packages it
    counts too, with what it uses itself: it may change what the modules compute. Compiled code
    counts by its bytes.

    Parameters
    ----------
    module : str
        Full name of an imported module.
    within : tuple of str
        Packages of ours that count besides. Of another project, all modules of the same package
        count, and with them every module that is not part of the standard library and of no
        installed distribution, unless it is installed as editable.
    """
    reached: set[tuple[str, bool]] = set()
    pending = [(module, True)]
    while pending:
        one = pending.pop()
        if one not in reached:
            reached.add(one)
            pending += _reached_from(*one, within, module)
    # The first goes without its name: a user's file has no lasting one as a module.
    names = sorted({name for name, _ in reached} - {module})
    others = (f"\0{name}\0{read(name)[0]}" for name in names)
    message = "".join([read(module)[0], *others])
    return hashlib.sha256(message.encode()).hexdigest()


def _reached_from(
    name: str, whole: bool, within: tuple[str, ...], root: str
) -> Iterator[tuple[str, bool]]:
    """Yield the modules that count with one, and whether all that they import counts too."""
    _, imports, used = read(name)
    near = (item for item in (imports if whole else used) if _near(item[0], within, root))
    found = (definer(*item) for item in near)
    yield from ((other, True) for other in found if _counts(other, within, root))
    home, *inner = name.split(".")
    if home != _OURS:  # Python runs these first: what they use at once themselves counts
        above = accumulate(inner[:-1], "{}.{}".format, initial=home)
        yield from ((other, False) for other in above if inner)


def _near(module: str, within: tuple[str, ...], root: str) -> bool:
    """Return whether it is worth looking where the names of ``module`` come from."""
    home = module.partition(".")[0]
    return home in {name.partition(".")[0] for name in (*within, root)} or _beside(module, root)


def _counts(module: str, within: tuple[str, ...], root: str) -> bool:
    if any(module == name or module.startswith(f"{name}.") for name in within):
        return True
    home = root.partition(".")[0]
    same_package = "." in root and home != _OURS and module.partition(".")[0] == home
    return same_package or _beside(module, root)


def _beside(module: str, root: str) -> bool:
    """Return whether ``module`` is a user's own code, as ``root`` is, or both are single files."""
    home, base = (name.partition(".")[0] for name in (module, root))
    if _OURS in {home, base}:
        return False
    single = home == module and base == root
    return is_own_code(home) or (single and not folders_of(home).isdisjoint(folders_of(base)))
