"""``mocapbench check``: whether a run is as good as a baseline, or better than a control."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from mocapbench.benchmark.errors import ExitCode, UsageError
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.gate import output as check_output
from mocapbench.benchmark.gate.check import differences, find, updated
from mocapbench.benchmark.gate.findings import Check
from mocapbench.benchmark.gate.reference import Baseline, of_records, read_baseline, write_baseline
from mocapbench.benchmark.gate.rule import Environment
from mocapbench.benchmark.gate.tolerances import read_tolerances
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.store import Store

__all__ = ["check"]


def check(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = Path("mocapbench-results"),
    baseline: Annotated[
        Path | None,
        typer.Option(help="A .csv file, a folder with one per task, or another run directory."),
    ] = None,
    tolerances: Annotated[
        Path | None, typer.Option(help="A TOML file of what may change; see docs/ci.md.")
    ] = None,
    environment: Annotated[
        Environment | None,
        typer.Option(help="How tight to be; by default what versions and machine say."),
    ] = None,
    controls: Annotated[
        bool, typer.Option("--controls", help="Rather: do samples surpass those of the control?")
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail too on what is better or new, until recorded.")
    ] = False,
    junit: Annotated[Path | None, typer.Option(help="JUnit XML to write.")] = None,
    markdown: Annotated[Path | None, typer.Option(help="Markdown summary to write.")] = None,
    update: Annotated[
        bool, typer.Option("--update", help="Make the run the baseline, and show what changes.")
    ] = False,
    allow_failures: Annotated[
        bool, typer.Option("--allow-failures", help="Update although jobs of the run failed.")
    ] = False,
) -> None:
    """Compare a run with a baseline, fold by fold; exit code 1 says that a metric got worse."""
    if (baseline is None) != controls:
        raise UsageError("expected something to check against: choose --baseline or --controls")
    if baseline is None:
        of_baseline = (tolerances, environment, strict, junit, markdown, update, allow_failures)
        if any(of_baseline):
            raise UsageError("--controls: expected no other option: they all go with --baseline")
        raise typer.Exit(_check_controls(run, Console()))
    for path in (junit, markdown):
        if path is not None and (path.is_dir() or not path.parent.is_dir()):
            raise UsageError(f"{path}: expected a file in a folder that exists")
    store, console = Store.open(run), Console()
    records, known = store.planned(), read_baseline(baseline)
    values = of_records(records, store.load_plan())
    for message in store.damaged:
        console.print(f"damaged, so left out: {message}", markup=False)
    if update:
        n_absent = len(store.load_plan()["keys"]) - len(records)
        _refuse_to_update(baseline, values, records, n_absent, allow_failures)
        known = known or Baseline({}, values.about)
        environment = environment or Environment.SAME  # whatever moves is worth a review
    if known is None:
        console.print(f"no baseline at {baseline}: write one with --update", soft_wrap=True)
        raise typer.Exit(ExitCode.NOTHING_RAN)
    differing = differences(known, values)
    level = environment or (Environment.CROSS if differing else Environment.SAME)
    findings = find(known, values, records, read_tolerances(level, tolerances))
    result = Check(findings, level, differing, strict)
    _show(result, console)
    _write(markdown, check_output.markdown(result).encode())
    _write(junit, check_output.junit(result))
    if update:
        write_baseline(baseline, updated(known, values, records))
        console.print(f"{baseline} now holds this run: review it like code", soft_wrap=True)
        raise typer.Exit(ExitCode.OK)
    if result.exit_code is ExitCode.NOTHING_RAN:
        console.print(
            f"nothing was compared: expected values that both {run} and {baseline} hold; "
            "run what the baseline holds, or record this run with --update",
            soft_wrap=True,
        )
    store.save_check({"baseline": str(baseline), **check_output.plain(result)})
    raise typer.Exit(result.exit_code)


def _check_controls(run: Path, console: Console) -> ExitCode:
    # Reports take a second to import, which every command would pay.
    from mocapbench.benchmark.gate.negative_control import check_controls  # noqa: PLC0415

    store = Store.open(run)
    records = store.planned()
    for message in store.damaged:
        console.print(f"damaged, so left out: {message}", markup=False)
    return check_controls(records, console)


def _refuse_to_update(
    baseline: Path, run: Baseline, records: Sequence[Record], n_absent: int, allow_failures: bool
) -> None:
    if baseline.is_dir() and Store.is_run(baseline):
        raise UsageError(f"--update: {baseline} is a run directory; name a .csv file or a folder")
    if baseline.is_file() and baseline.suffix != ".csv":
        raise UsageError(f"--update: expected a .csv file or a folder, got the file {baseline}")
    if n_absent:
        raise UsageError(
            f"--update: {n_absent} jobs of the run have no whole record, so a baseline would lack "
            "them; resume it with `mocapbench run`"
        )
    failed = [record for record in records if record.status.broken]
    if failed and not allow_failures:
        raise UsageError(
            f"--update: {len(failed)} jobs failed ({failed[0].label}: {failed[0].message}); mend "
            "them, or keep their old values with --allow-failures"
        )
    if not run.values:
        raise UsageError("--update: the run holds no value; run it first")


def _show(result: Check, console: Console) -> None:
    table = check_output.terminal(result)
    if table.row_count:
        console.print(table)
    console.print(f"check: {check_output.summary(result)}", soft_wrap=True, markup=False)


def _write(path: Path | None, content: bytes) -> None:
    if path is not None:
        with atomic_write(path) as file:
            file.write(content)
