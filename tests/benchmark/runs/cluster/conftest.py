import os
import subprocess
import sys

import pytest
from distributed import Client, LocalCluster


@pytest.fixture
def scheduler():
    """Return the address of a scheduler with two workers, which their nannies restart."""
    options = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0", "memory_limit": 0}
    with LocalCluster(n_workers=2, threads_per_worker=1, **options) as cluster:
        yield cluster.scheduler_address


@pytest.fixture
def lone_worker():
    """Return a function that starts a scheduler with one worker, and folders on its path."""
    processes = []

    def start(*path):
        options = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0"}
        cluster = LocalCluster(n_workers=0, **options)
        command = [sys.executable, "-m", "distributed.cli.dask_worker", cluster.scheduler_address]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, path))}
        worker = subprocess.Popen(
            [*command, "--no-nanny", "--no-dashboard"], env=environment, stderr=subprocess.DEVNULL
        )
        processes.extend([cluster, worker])
        with Client(cluster) as client:
            client.wait_for_workers(1)
        return cluster.scheduler_address

    yield start
    if processes:
        cluster, worker = processes
        worker.kill()
        worker.wait()
        cluster.close()
