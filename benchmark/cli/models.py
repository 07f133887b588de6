"""``mocapbench models``: the commands that mocapbench brings along, and what they need."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Column, Table

from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.programs.declaration import (
    find_requirements,
    is_declaration,
    read_declaration,
)
from mocapbench.benchmark.programs.entrants import find_entrants
from mocapbench.benchmark.programs.environments import (
    find_environment,
    find_environments,
    install_environment,
    sweep_environments,
)

__all__ = ["app"]

app: typer.Typer = typer.Typer(
    help="List models that are commands, and install what they need.",
    no_args_is_help=True,
    add_completion=False,
)


@app.command("list")
def list_entrants() -> None:
    """List the commands that mocapbench brings along, and which are installed."""
    sweep_environments()
    table = Table(Column("model", no_wrap=True), "what it is", "packages", "installed")
    for name, path in find_entrants().items():
        packages = _find_packages(path)
        installed = "yes" if find_environment(packages).exists() else "no"
        table.add_row(name, read_declaration(path).get("summary"), packages.stem, installed)
    console = LiteralConsole()
    console.print(table)
    console.print(
        f"`mocapbench models install NAME` installs packages into {find_environments()}",
        soft_wrap=True,
        highlight=False,
    )


@app.command()
def install(
    names: Annotated[
        list[str],
        typer.Argument(help="Models or packages of `mocapbench models list`, or own TOML files."),
    ],
) -> None:
    """Install the packages of models, from the package index, each in an environment of its own.

    Nothing else on this machine changes: all is in one folder of the cache, which can be deleted.
    """
    console = LiteralConsole()
    for packages in dict.fromkeys(_select_packages(names)):
        if find_environment(packages).exists():
            console.print(f"{packages.stem}: is installed already", soft_wrap=True)
        else:
            _install_packages(packages, console)


def _select_packages(names: Iterable[str]) -> Iterator[Path]:
    """Yield the file of packages of each model that is named, or that itself is named.

    Raises
    ------
    UsageError
        If there is none of a name.
    """
    models = {name: _find_packages(path) for name, path in find_entrants().items()}
    known = {**{packages.stem: packages for packages in models.values()}, **models}
    for name in names:
        if is_declaration(Path(name)):
            yield _find_packages(Path(name))
        elif name in known:
            yield known[name]
        else:
            raise UnknownNameError("model", name, sorted(known))


def _find_packages(path: Path) -> Path:
    if packages := find_requirements(path):
        return packages
    raise UsageError(
        f'{path}: expected requirements = "FILE", a list of packages beside it, got none; nothing '
        "is to be installed"
    )


def _install_packages(packages: Path, console: LiteralConsole) -> None:
    """Install packages, and say how far it is in one line of a terminal, or else in many."""
    with console.status(f"{packages.stem}: beginning") as status:
        show = status.update if console.is_terminal else partial(console.print, soft_wrap=True)
        try:
            place = install_environment(packages, lambda news: show(f"{packages.stem}: {news}"))
        except KeyboardInterrupt:
            console.print(f"{packages.stem}: interrupted; nothing was installed")
            raise
    console.print(f"{packages.stem}: installed in {place}", soft_wrap=True, highlight=False)
