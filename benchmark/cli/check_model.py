"""``mocapbench check-model``: whether the user's own models keep what their abilities promise."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.child import ProcessDiedError, call_in_child
from mocapbench.basics.system.choice import find_system
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.programs.entrants import locate_plugin
from mocapbench.benchmark.runs.execution.worker import load_plugins_once
from mocapbench.benchmark.testing import model_checks

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command("check-model")
def check_model(
    files: Annotated[
        list[Path],
        typer.Argument(help="TOML files of commands, or Python files that define MODELS."),
    ],
    timeout: Annotated[
        float, typer.Option(min=1.0, help="Seconds that a model has for each check.")
    ] = 120.0,
) -> None:
    """Check that your own models keep what their abilities promise.

    They fill small recordings in odd orders, with odd masks and seeds. The exit code is 0 if all is
    well, and else 2.
    """
    console = LiteralConsole()
    prepare = partial(load_plugins_once, tuple(map(locate_plugin, files)))
    faults = [
        _find_fault(console, name, check, prepare, timeout)
        for name in _load_models(files, prepare)
        for check in model_checks(bench.MODELS.get(name))
    ]
    failed = sum(map(bool, faults))
    console.print(f"{format_count(len(faults), 'check')}: {failed} failed")
    raise typer.Exit(ExitCode.USAGE if failed else ExitCode.OK)


def _load_models(files: list[Path], prepare: Callable[[], None]) -> list[str]:
    """Register what files define, and return the names of their models, each with one seed.

    Raises
    ------
    UsageError
        If there is none.
    """
    before = {*bench.MODELS.names()}
    prepare()
    new = sorted({*bench.MODELS.names()} - before)
    names = [name for name in new if not getattr(bench.MODELS.get(name), "same_as", "")]
    if not names:
        listed = ", ".join(map(str, files))
        raise UsageError(f"expected files that define models, got none in {listed}")
    return names


def _find_fault(
    console: LiteralConsole,
    name: str,
    check: Callable[..., None],
    prepare: Callable[[], None],
    timeout: float,
) -> str:
    """Return what a check of a model finds, which is said too; an empty text if all is well."""
    try:
        fault = str(call_in_child(_try_check, check, name, timeout=timeout, prepare=prepare))
    except TimeoutError:
        fault = f"expected an end within {timeout:g} s, got none; --timeout gives more"
    except ProcessDiedError as error:
        fault = f"its process died with exit code {error.exit_code}"
    words = check.__name__.replace("_", " ")
    console.print(f"{name} {words}: {fault or 'ok'}", soft_wrap=True)
    return fault


def _try_check(check: Callable[..., None], name: str) -> str:
    """Return what a check finds in this process, whose memory is limited as that of a job."""
    find_system().limit_memory(bench.memory_share(1) * 2**30)
    try:
        check(bench.MODELS.get(name))
    except Exception as error:
        return reason(error).partition(": ")[2].removeprefix(f"{name}: ")
    return ""
