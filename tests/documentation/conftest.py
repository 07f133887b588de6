"""The folder in which the blocks of a page are tried."""

import os
import shutil
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from code_desk import lay_out
from distributed import LocalCluster
from filelock import FileLock


@pytest.fixture(scope="session")
def small_files(tmp_path_factory, worker_id):
    """Return a folder of small files, made once for all processes that run tests."""
    own = tmp_path_factory.getbasetemp()
    shared = (own if worker_id == "master" else own.parent) / "small-files"
    with FileLock(f"{shared}.lock"), pytest.MonkeyPatch.context() as patch:
        if not shared.exists():
            _alone(patch, tmp_path_factory.mktemp("cache"))
            lay_out(shared, patch)
    return shared


@pytest.fixture
def desk(small_files, tmp_path, monkeypatch):
    """Enter a copy of the small files, with no recordings besides, and return its path.

    A cluster on this machine stands for SLURM's, of which scripts are imported, not run.
    """
    _alone(monkeypatch, tmp_path)
    folder = shutil.copytree(small_files, tmp_path / "desk")
    monkeypatch.chdir(folder)
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(sys.modules, "channel_mean", raising=False)
    monkeypatch.setitem(sys.modules, "dask_jobqueue", SimpleNamespace(SLURMCluster=LocalCluster))
    return folder


def _alone(patch, cache):
    patch.delenv("MOCAPBENCH_DATA", raising=False)
    patch.setenv("MOCAPBENCH_CACHE", str(cache))
    patch.setenv("HOME", str(cache))
    patch.setenv("COLUMNS", "100")
    patch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
