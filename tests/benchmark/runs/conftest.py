import time

import psutil
import pytest

from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.source_code import reading
from mocapbench.benchmark.tasks.address import Address


@pytest.fixture
def store(tmp_path):
    return RunDirectory.create(tmp_path / "run")


@pytest.fixture
def record():
    return Record("k" * 64, "f", Address("t", 1, "c", 0, "label"), 0, "model", {}, Status.OK)


@pytest.fixture
def append(monkeypatch, forget):
    """Return a function that appends a line to one module, as digests read it."""
    read = reading._source

    def append(module, line="CHANGED = 1"):
        def source(name):
            return f"{read(name)}\n{line}\n" if name == module else read(name)

        monkeypatch.setattr(reading, "_source", source)
        forget()

    return append


def _is_over(process):
    try:
        return process.status() == psutil.STATUS_ZOMBIE  # nobody may be there to take note
    except psutil.NoSuchProcess:
        return True


@pytest.fixture
def ends():
    """Return a function that waits for a process to end, and says whether it did."""

    def ends(process):
        for _ in range(300):
            if _is_over(process):
                return True
            time.sleep(0.1)
        return False

    return ends
