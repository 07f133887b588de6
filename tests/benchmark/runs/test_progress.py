"""The progress of a run is shown, whatever the messages of its jobs."""

import io

import pytest
from rich.console import Console

from mocapbench.benchmark.runs.job import Outcome
from mocapbench.benchmark.runs.progress import watch
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address


def _refuse(text):
    raise AssertionError("asked to look for what to highlight, which is slow in long words")


@pytest.mark.parametrize(
    "message", ["x" * 50_000, "many words " * 1000 + "end", "[link=x]y[/link]"]
)
@pytest.mark.parametrize("terminal", [False, True])
def test_a_message_is_one_line_that_is_not_searched(message, terminal):
    console = Console(
        file=io.StringIO(),
        width=80,
        highlighter=_refuse,
        force_terminal=terminal,
        color_system=None,
    )
    address = Address("task", 1, "case", 0, "model")
    record = Record("k", "f", address, 0, "model", {}, Status.FAILED, message)
    outcome = Outcome(record, seconds=1.0)
    assert [*watch([outcome], 1, lambda: 0.0, console)] == [outcome]
    expected = f"failed: task · case · model · fold 1 (fold 0 in tables): {message}\n"
    assert expected in console.file.getvalue()
