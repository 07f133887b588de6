"""Memory in large pages: the same memory, in pages that a fork copies faster."""

import platform
import re
from pathlib import Path

import numpy as np
import pytest

from mocapbench.basics.child import call_in_child
from mocapbench.basics.system import large_pages

pytestmark = pytest.mark.forks

SIZE = 16 << 20  # bytes


def _kilobytes_in_large_pages():
    rollup = Path("/proc/self/smaps_rollup").read_text()
    return int(re.search(r"AnonHugePages:\s+(\d+)", rollup)[1])


def _before_and_after():
    memory = np.arange(SIZE // 8)
    before = _kilobytes_in_large_pages()
    large_pages.collapse_memory()
    return before, _kilobytes_in_large_pages(), bool(np.all(memory == np.arange(SIZE // 8)))


def _can_gather_pages():
    setting = Path("/sys/kernel/mm/transparent_hugepage/enabled")
    kernel = tuple(map(int, re.findall(r"\d+", platform.release())[:2]))
    return kernel >= (6, 1) and setting.exists() and "[never]" not in setting.read_text()


@pytest.mark.skipif(not _can_gather_pages(), reason="needs Linux 6.1 and pages of 2 MB")
def test_memory_keeps_its_content_and_gets_larger_pages():
    before, after, is_kept = call_in_child(_before_and_after, timeout=60)
    assert is_kept
    assert after > before


def test_a_system_that_cannot_do_it_leaves_what_memory_holds(monkeypatch):
    monkeypatch.setattr(large_pages, "_MADV_COLLAPSE", 9999)
    *_, is_kept = call_in_child(_before_and_after, timeout=60)
    assert is_kept  # its pages are not counted: the system gathers and splits them by itself, too
