"""Which backend the user asks for; the module of a backend is imported only for those who do."""

from __future__ import annotations

import importlib
import importlib.util
import re

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.execution.base import Backend
from mocapbench.benchmark.runs.machine import n_cores

__all__ = ["open_backend", "require_backend"]


_CLUSTER = "mocapbench.benchmark.runs.cluster"
_THIS_MACHINE = "mocapbench.benchmark.runs.execution.this_machine"
_MODULES = {"--scheduler": f"{_CLUSTER}.scheduler", "--cluster": f"{_CLUSTER}.local"}
"""Each has ``open_backend``, which takes the value of the option."""
_FORMS = {
    "--scheduler": (r".*", "tcp://10.0.0.1:8786"),
    "--cluster": (r"local:[1-9]\d*", "local:4"),
}
"""A regular expression that the value matches, and an example."""
_PACKAGE = "distributed"
"""What a cluster imports that mocapbench does not always bring."""


def open_backend(
    jobs: int | None, scheduler: str | None = None, cluster: str | None = None
) -> Backend:
    """Return the backend that the user asks for; this machine if no other.

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
        If more than one is asked for, or the backend cannot be had.
    """
    require_backend(jobs, scheduler, cluster)
    for option, value in {"--scheduler": scheduler, "--cluster": cluster}.items():
        if value is not None:
            backend: Backend = importlib.import_module(_MODULES[option]).open_backend(value)
            return backend
    here: Backend = importlib.import_module(_THIS_MACHINE).ThisMachine(jobs or n_cores())
    return here


def require_backend(jobs: int | None, scheduler: str | None, cluster: str | None) -> None:
    """Refuse what `open_backend` cannot open, as far as that shows before it is tried.

    Raises
    ------
    UsageError
        If more than one backend is asked for, its package is missing, or a value has another form.
    """
    options = {"--jobs": jobs, "--scheduler": scheduler, "--cluster": cluster}
    given = {option: str(value) for option, value in options.items() if value is not None}
    if len(given) > 1:
        raise UsageError(
            f"expected one of {', '.join(options)}, got {' and '.join(given)}; leave out all but "
            "one (a cluster's workers decide how many jobs run at once)"
        )
    for option in given.keys() & _FORMS:
        _require_cluster(option, given[option])


def _require_cluster(option: str, value: str) -> None:
    form, example = _FORMS[option]
    if re.fullmatch(form, value) is None:
        raise UsageError(
            f"{option}: expected a value such as {example}, got {value!r}; --cluster local:4 "
            "starts 4 workers here, --scheduler takes the address of a cluster that is there"
        )
    if importlib.util.find_spec(_PACKAGE) is None:
        raise UsageError(
            f"{option}: expected the package {_PACKAGE!r}, got none; "
            f"`pip install 'mocapbench[cluster]'` installs it"
        )
