"""The command line's entrance, which loads the commands only once it knows how to end."""

from __future__ import annotations

import sys
import warnings
from collections import Counter
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
    shown = _Warnings()
    with wind_up_at_signals(), whole_outputs(), warnings.catch_warnings():
        show: Callable[..., None] = shown.show
        warnings.showwarning = show
        try:
            cli.app(args=None if arguments is None else list(arguments))
        except Exception as error:
            sys.exit(cli.explain(error))
        finally:
            shown.count_others()


class _Warnings:
    """Shows each warning once: Python forgets those it showed when its filters change.

    Of a kind that may come for each of a hundred files, the first is shown, and the others counted.
    """

    def __init__(self) -> None:
        self._shown: set[tuple[str, type[Warning]]] = set()
        self._others: Counter[type[Warning]] = Counter()

    def show(self, message: Warning | str, category: type[Warning], *origin: Any) -> None:
        """Show a warning, or count it; in place of `warnings.showwarning`."""
        if (str(message), category) in self._shown:
            return
        is_first = all(category is not other for _, other in self._shown)
        self._shown.add((str(message), category))
        if is_first or not hasattr(category, "of_many"):
            cli.show_warning(message, category, *origin)  # imported late, as it takes time
        else:
            self._others[category] += 1

    def count_others(self) -> None:
        """Say how many warnings of a kind were not shown."""
        for category, count in self._others.items():
            text = f"{category.of_many}: {count} more"  # type: ignore[attr-defined]
            cli.show_warning(text, category, "", 0)


if __name__ == "__main__":
    main()
