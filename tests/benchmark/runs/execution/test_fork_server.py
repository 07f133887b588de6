"""The server of workers: it starts ahead of them, and they are its children."""

import os

import psutil

from mocapbench import benchmark as bench
from mocapbench.benchmark.runs.execution.worker_pool import worker_pool


def test_workers_come_from_the_server_that_was_started_ahead():
    bench.load_libraries_ahead()
    servers = {child.pid for child in psutil.Process().children()}
    bench.load_libraries_ahead()
    assert {child.pid for child in psutil.Process().children()} == servers
    with worker_pool(1) as pool:
        assert pool.schedule(os.getppid).result() in servers
