"""A worker that joins during a run is held to the same as those that were there before."""

from types import SimpleNamespace

import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.installation import installation
from mocapbench.benchmark.runs.cluster.run_plugin import RunPlugin


def test_a_worker_with_another_version_refuses_jobs(tmp_path):
    expected = {**installation(), "scipy": "0.1"}
    plugin = RunPlugin("a run", None, {}, expected)
    worker = SimpleNamespace(address="tcp://there", local_directory=tmp_path)
    plugin.setup(worker)
    with pytest.raises(UsageError, match=r"worker tcp://there: expected scipy 0\.1, got"):
        plugin.run(worker, None, {})
    plugin.teardown(worker)
    assert not any(tmp_path.iterdir())
