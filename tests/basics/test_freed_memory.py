"""Freed memory is given back, or nothing happens."""

import ctypes

import numpy as np
import psutil
import pytest

from mocapbench.basics.freed_memory import return_freed_memory


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "malloc_trim"), reason="of the GNU C library")
def test_what_freed_arrays_took_is_given_back():
    np.ones(2**21)  # 16 MiB, after which the library keeps blocks as large
    kept = [np.ones(2**20) for _ in range(20)]
    between = [bytes(100) for _ in range(1000)]
    kept.append(np.ones(1000))
    del kept[:20]
    before = psutil.Process().memory_info().rss
    return_freed_memory()
    assert psutil.Process().memory_info().rss <= before
    assert len(between) == 1000


def test_a_library_without_such_a_function_is_left_alone(monkeypatch):
    monkeypatch.setattr(ctypes, "CDLL", lambda name: object())
    return_freed_memory()
