"""``mocapbench check``: whether a run is as good as reference values, or better than a control."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench.basics.whole_files import encode_text, write_files
from mocapbench.benchmark import gate
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    Plugins,
    load_plugins,
    require_writable,
    show_left_out,
)
from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.gate.environment import Environment

if TYPE_CHECKING:
    from mocapbench.benchmark import Record
    from mocapbench.benchmark.gate import Check, Reference

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

NO_REFERENCE = "no reference values at {reference}: write some with --update"
NOTHING_COMPARED = (
    "nothing was compared: expected values that both {run} and {reference} hold; "
    "run what the reference holds, or record this run with --update"
)


@app.command()
def check(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
    reference: Annotated[
        Path | None,
        typer.Option(
            "--reference",
            help="Reference values: a .csv file, a folder with one per task, or another run.",
        ),
    ] = None,
    tolerances: Annotated[
        Path | None, typer.Option(help="A TOML file of what may change; see docs/ci.md.")
    ] = None,
    environment: Annotated[
        Environment | None,
        typer.Option(help="How tight to be; by default what versions and machine say."),
    ] = None,
    controls: Annotated[
        bool,
        typer.Option(
            "--controls",
            help="Check samples against the negative control instead of reference values.",
        ),
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail too on what is better or new, until recorded.")
    ] = False,
    junit: Annotated[Path | None, typer.Option(help="JUnit XML to write.")] = None,
    markdown: Annotated[Path | None, typer.Option(help="Markdown summary to write.")] = None,
    update: Annotated[
        bool, typer.Option("--update", help="Make the run the reference, and show what changes.")
    ] = False,
    allow_failures: Annotated[
        bool, typer.Option("--allow-failures", help="Update although jobs of the run failed.")
    ] = False,
    plugin: Plugins = None,
) -> None:
    """Check that no metric of a run is worse than its reference.

    Values are paired by fold. Exit code 1 says that a metric got worse.
    """
    load_plugins(plugin)
    if (reference is None) != controls:
        raise UsageError("expected something to check against: choose --reference or --controls")
    if reference is None:
        if any((tolerances, environment, strict, junit, markdown, update, allow_failures)):
            raise UsageError("--controls: expected no other option: they all go with --reference")
        raise typer.Exit(_check_controls(run, LiteralConsole()))
    require_writable(junit, markdown)
    store, console = bench.RunDirectory(run), LiteralConsole()
    records, plan = store.planned(), store.load_plan()
    known, values = gate.read_reference(reference), gate.of_records(records, plan)
    show_left_out(store.damaged, console)
    if update:
        gate.require_updatable(reference, values, records, len(plan["keys"]), allow_failures)
        known = known or gate.Reference({}, values.about)
        environment = environment or Environment.SAME  # whatever moves is worth a review
    if known is None:
        console.print(NO_REFERENCE.format(reference=reference), soft_wrap=True)
        raise typer.Exit(ExitCode.NOTHING_RAN)
    result = _compare_values(
        known, values, records, environment=environment, tolerances=tolerances, strict=strict
    )
    _show(result, console)
    _write(result, markdown, junit)
    if update:
        gate.write_reference(reference, gate.update_values(known, values, records))
        console.print(f"{reference} now holds this run: review it like code", soft_wrap=True)
        raise typer.Exit(ExitCode.OK)
    if result.exit_code is ExitCode.NOTHING_RAN:
        console.print(NOTHING_COMPARED.format(run=run, reference=reference), soft_wrap=True)
    store.save_check({"reference": str(reference), **gate.plain(result)})
    raise typer.Exit(result.exit_code)


def _check_controls(run: Path, console: LiteralConsole) -> ExitCode:
    store = bench.RunDirectory(run)
    records = store.planned()
    show_left_out(store.damaged, console)
    return gate.check_controls(records, console)


def _compare_values(
    known: Reference,
    values: Reference,
    records: Sequence[Record],
    *,
    environment: Environment | None,
    tolerances: Path | None,
    strict: bool,
) -> Check:
    """Return what comes of a run beside the reference, as tight as the environment allows."""
    differing = gate.differences(known, values)
    level = environment or (Environment.CROSS if differing else Environment.SAME)
    findings = gate.check(known, values, records, gate.read_tolerances(level, tolerances))
    return gate.Check(findings, level, differing, strict)


def _show(result: Check, console: LiteralConsole) -> None:
    table = gate.terminal(result)
    if table.row_count:
        console.print(table)
    console.print(f"check: {gate.summary(result)}", soft_wrap=True)


def _write(result: Check, markdown: Path | None, junit: Path | None) -> None:
    contents = {}
    if markdown is not None:
        contents[markdown] = encode_text(gate.markdown(result))
    if junit is not None:
        contents[junit] = gate.junit(result)
    write_files(contents)
