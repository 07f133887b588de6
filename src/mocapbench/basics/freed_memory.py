"""Memory that this process no longer needs."""

from __future__ import annotations

import ctypes

__all__ = ["return_freed_memory"]


def return_freed_memory() -> None:
    """Give back to the system what freed arrays took.

    The GNU C library keeps blocks of less than 32 MiB, such as masks of long recordings, which may
    be hundreds of megabytes together. Others have no such function, nor need for it. It is looked
    for among those that Python has loaded.
    """
    trim = getattr(ctypes.pythonapi, "malloc_trim", None)
    if trim is not None:
        trim(0)
