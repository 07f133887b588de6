"""One backend is chosen, and nobody pays for one that is not."""

import importlib.util
import subprocess
import sys

import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.execution.choice import open_backend
from mocapbench.benchmark.runs.machine import n_cores


def test_without_a_choice_jobs_run_here_one_per_core():
    with open_backend(None) as backend:
        assert backend.n_workers == n_cores()


def test_two_choices_are_refused():
    with pytest.raises(UsageError, match="got --jobs and --cluster; leave out all but one"):
        open_backend(2, cluster="local:2")


def test_a_missing_package_is_named_with_the_command_that_installs_it(monkeypatch):
    find = importlib.util.find_spec
    without = lambda name, *rest: None if name == "distributed" else find(name, *rest)  # noqa: E731
    monkeypatch.setattr(importlib.util, "find_spec", without)
    with pytest.raises(UsageError, match=r"got none; `pip install 'mocapbench\[cluster\]'`"):
        open_backend(None, cluster="local:2")


@pytest.mark.parametrize("kind", ["local", "local:0", "local:-1", "local:two", "slurm:2", ""])
def test_a_cluster_of_another_form_is_refused(kind):
    with pytest.raises(UsageError, match="expected a value such as local:4"):
        open_backend(None, cluster=kind)


@pytest.mark.parametrize("address", ["127.0.0.1:1", "tcp://127.0.0.1:1", "nonsense://x", ""])
def test_a_scheduler_that_does_not_answer_is_refused(address, monkeypatch):
    monkeypatch.setattr("mocapbench.benchmark.runs.cluster.scheduler._PATIENCE", 0.2)
    with pytest.raises(UsageError, match="expected the address of a dask scheduler that answers"):
        open_backend(None, scheduler=address)


@pytest.mark.slow
def test_a_run_on_this_machine_imports_no_dask():
    code = (
        "import sys; from mocapbench import benchmark as b; b.run, b.open_backend(1)\n"
        "assert not {'distributed', 'dask'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
