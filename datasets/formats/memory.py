"""Whether a file fits in memory, before any of it is read."""

from __future__ import annotations

import psutil

from mocapbench.datasets.formats.errors import FormatError

__all__ = ["check_fits"]

_MIB = 2**20


def check_fits(file: str, size: int, memory: float) -> None:
    """Refuse what takes more memory than this machine has free.

    Parameters
    ----------
    file : str
        Name of the file in the message.
    size : int
        Its bytes.
    memory : float
        Bytes of memory that reading it takes.

    Raises
    ------
    FormatError
        If they are more than are available.
    """
    available = psutil.virtual_memory().available
    if memory > available:
        raise FormatError(
            file,
            f"a file that can be read in the {available / _MIB:.0f} MiB of memory that are free",
            f"{size / _MIB:.0f} MiB that take {memory / _MIB:.0f} MiB to read",
            "cut the file into parts, or use a machine with more memory",
        )
