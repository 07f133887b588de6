"""``mocapbench info``: versions, the machine, and how to cite."""

from __future__ import annotations

import typer
from rich.table import Table

from mocapbench import benchmark as bench
from mocapbench import datasets
from mocapbench.benchmark.cli.console import LiteralConsole

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

_CITATION = """\
@software{mocapbench,
  title  = {mocapbench: reproducible benchmarks of models of human motion},
  author = {{The mocapbench developers}},
  year   = {2026},
}"""


@app.command()
def info() -> None:
    """Show versions, the machine, and how to cite."""
    table = Table(show_header=False, box=None)
    for name, value in bench.provenance(["mocapbench", "info"], threads=1).items():
        table.add_row(name, value)
    console = LiteralConsole()
    console.print(table)
    text = f"\n{_CITATION}\n\n{datasets.CMU_ACKNOWLEDGEMENT}"
    console.print(text, highlight=False)
