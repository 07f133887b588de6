"""Which site the user asks for; the module of a site is imported only for those who do."""

from __future__ import annotations

import importlib
import importlib.util
from typing import NamedTuple

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.execution.base import Site
from mocapbench.benchmark.runs.execution.this_machine import ThisMachine
from mocapbench.benchmark.runs.machine import n_cores

__all__ = ["open_site"]


class _Kind(NamedTuple):
    """A kind of site: its module has ``open_site``, which takes the value of the option."""

    module: str
    package: str
    """What the module imports that mocapbench does not always bring."""
    extra: str


_CLUSTER = "mocapbench.benchmark.runs.cluster"
_KINDS = {
    "--scheduler": _Kind(f"{_CLUSTER}.scheduler", "distributed", "cluster"),
    "--cluster": _Kind(f"{_CLUSTER}.local", "distributed", "cluster"),
}


def open_site(jobs: int | None, scheduler: str | None = None, cluster: str | None = None) -> Site:
    """Return the site that the user asks for; this machine if no other.

    Parameters
    ----------
    jobs : int or None
        How many jobs run at once on this machine; None means one per core.
    scheduler : str or None
        The address of a dask scheduler.
    cluster : str or None
        A cluster to start: ``local:N``.

    Raises
    ------
    UsageError
        If more than one is asked for, or the site cannot be had.
    """
    asked = {"--jobs": jobs, "--scheduler": scheduler, "--cluster": cluster}
    given = {option: str(value) for option, value in asked.items() if value is not None}
    if len(given) > 1:
        raise UsageError(
            f"expected one of {', '.join(asked)}, got {' and '.join(given)}; leave out all but "
            "one (a cluster's workers decide how many jobs run at once)"
        )
    for option, value in given.items():
        if option in _KINDS:
            return _open(_KINDS[option], option, value)
    return ThisMachine(jobs or n_cores())


def _open(kind: _Kind, option: str, value: str) -> Site:
    if importlib.util.find_spec(kind.package) is None:
        raise UsageError(
            f"{option}: expected the package {kind.package!r}, got none; "
            f"`pip install 'mocapbench[{kind.extra}]'` installs it"
        )
    site: Site = importlib.import_module(kind.module).open_site(value)
    return site
