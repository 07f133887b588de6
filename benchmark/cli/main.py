"""The command line's entrance, which loads the commands only once it knows how to end."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Sequence
from typing import Any

from mocapbench.benchmark import cli
from mocapbench.benchmark.cli.ending.outputs import whole_outputs
from mocapbench.benchmark.cli.ending.signals import wind_up_at_signals
from mocapbench.benchmark.cli.running.search_path import forget_empty_entries

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line; errors become one line and an exit code."""
    forget_empty_entries()
    with wind_up_at_signals(), whole_outputs(), warnings.catch_warnings():
        warnings.showwarning = _showing_each_once()
        try:
            cli.app(args=None if arguments is None else list(arguments))
        except Exception as error:
            sys.exit(cli.explain(error))


def _showing_each_once() -> Callable[..., None]:
    """Return what shows warnings; Python forgets those it showed when its filters change."""
    shown: set[tuple[str, type[Warning]]] = set()

    def show(message: Warning | str, category: type[Warning], *origin: Any) -> None:
        if (str(message), category) not in shown:
            shown.add((str(message), category))
            cli.show_warning(message, category, *origin)  # imported late, as it takes time

    return show


if __name__ == "__main__":
    main()
