"""``mocapbench leaderboard``: the archives of several laboratories as one site."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.scratch import scratch_folder
from mocapbench.basics.whole_files import write_text, write_together
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.errors import UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark import Record

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

_PAGES = ("index.html", "report.html", "scores.csv")


@app.command()
def leaderboard(
    archives: Annotated[
        list[Path], typer.Argument(help="Archives of `mocapbench submit`; the first goes first.")
    ],
    out: Annotated[Path, typer.Option(help="The folder of the site.")] = Path("site"),
) -> None:
    """Build a site of what several laboratories have sent.

    Everything is checked first: if two archives have different scores of one job or different
    recordings, or one is of another version of a task, nothing is written.
    """
    _require_own_folder(out)
    if len({path.resolve() for path in archives}) < len(archives):
        raise UsageError(f"expected each archive once, got {', '.join(map(str, archives))}")
    with scratch_folder() as folder:
        submissions = {
            str(path): bench.read_submission(path, folder / f"{number}")
            for number, path in enumerate(archives, start=1)
        }
        united = bench.unite_submissions(submissions)
        entrants = bench.describe_entrants(submissions, united)
        records = [record for of_archive in united.values() for record in of_archive]
    if not any(record.scores for record in records):
        raise UsageError("expected scores, got none in any archive; have others sent")
    names = [path.name for path in archives]
    _write_pages(out, reports.render_leaderboard(entrants, _tabulate(records), names), records)
    LiteralConsole().print(
        f"{format_count(len(entrants), 'entrant')}: {(out / 'index.html').resolve()}",
        soft_wrap=True,
    )


def _require_own_folder(out: Path) -> None:
    """Refuse what is no folder, and one with files of anything else, such as a run directory."""
    if out.exists() and not out.is_dir():
        raise UsageError(f"--out: expected a folder, got the file {out}; name another folder")
    others = sorted({path.name for path in out.iterdir()} - {*_PAGES}) if out.exists() else []
    if others:
        raise UsageError(
            f"--out: expected a new or empty folder, or a site, got {out} with {others[0]}; name "
            "another folder"
        )


def _tabulate(records: Sequence[Record]) -> list[reports.Table]:
    """Return the table of each task by its first metric."""
    whole = bench.bundle(records, {})
    tasks = bench.find_tasks(whole, ())
    return list(reports.paper_tables(whole, tasks, (), bench.find_labels(whole, ()), ())[1])


def _write_pages(out: Path, page: str, records: Sequence[Record]) -> None:
    """Write all files of the site, or none."""
    whole = bench.bundle(records, {})
    contents = page, reports.render(whole), reports.csv_text(whole.scores)
    out.mkdir(parents=True, exist_ok=True)
    with write_together(out, "site") as drafts:
        for name, content in zip(_PAGES, contents, strict=True):
            write_text(drafts / name, content)
