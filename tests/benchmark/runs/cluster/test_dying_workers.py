"""A worker that dies while a run begins is no reason to refuse the cluster."""

from types import SimpleNamespace

import pytest
from distributed.comm import CommClosedError

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.cluster.admission import require_workers
from mocapbench.benchmark.runs.cluster.executor import ClusterExecutor
from mocapbench.benchmark.runs.cluster.installation import installation
from mocapbench.benchmark.runs.job import WorkerConfig


class MortalCluster:
    """Stands for a client of a cluster in which a worker dies when it is asked."""

    id = "client"

    def __init__(self, *, answer=None, deaths=0):
        self.answer = answer
        self.deaths = deaths
        self.given = []

    def wait_for_workers(self, *_, **__):
        """Find one."""

    def run_on_scheduler(self, function):
        return function()

    def run(self, function, **_):
        return {"tcp://here": function(), "tcp://other": self.answer or function()}

    def register_plugin(self, plugin):
        if hasattr(plugin, "setup"):
            self.deaths -= 1
            if self.deaths >= 0:
                raise CommClosedError("in <TCP>: Stream is closed")
        self.given.append(plugin.name)


def test_a_worker_that_is_gone_when_it_is_asked_is_left_out():
    require_workers(MortalCluster(answer=CommClosedError("in <TCP>: Stream is closed")))
    require_workers(MortalCluster(answer=installation()))


@pytest.mark.parametrize("answer", [ImportError("no mocapbench"), {"numpy": "0.1"}])
def test_a_worker_that_answers_with_another_installation_is_refused(answer):
    with pytest.raises(UsageError, match="worker tcp://other: expected"):
        require_workers(MortalCluster(answer=answer))


@pytest.fixture
def start():
    """Return a function that starts a run on a cluster."""
    config = WorkerConfig((), (), timeout=60.0, memory=2**30, threads=1, provenance={})
    return lambda client: ClusterExecutor(client, config, SimpleNamespace())


def test_what_a_run_brings_is_given_again_if_a_worker_dies_meanwhile(start):
    for deaths in range(3):
        cluster = MortalCluster(deaths=deaths)
        start(cluster)
        watch, plugin = cluster.given
        assert watch == f"{plugin}-watch"


def test_a_cluster_that_never_takes_it_is_an_error(start):
    with pytest.raises(CommClosedError):
        start(MortalCluster(deaths=99))
