"""The process in which `call_isolated` has functions called, one after another.

A request is a line of JSON; an answer is its length and an .npz file. The process ends with the
one that started it, whose end closes the pipe of requests.
"""

from __future__ import annotations

import json
import os
import resource
import sys
from collections.abc import Mapping
from importlib import import_module
from io import BytesIO
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

__all__ = ["LENGTH", "serve"]

LENGTH = 8
"""Bytes of the number that precedes an answer."""


def serve() -> None:
    """Answer requests until there are no more."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what libraries print is not an answer
    for line in sys.stdin.buffer:
        data = BytesIO()
        np.savez(data, allow_pickle=False, **_call_function(*json.loads(line)))
        answers.write(data.tell().to_bytes(LENGTH) + data.getbuffer())
        answers.flush()


def _call_function(function: str, arguments: list[str], memory: int) -> Mapping[str, NDArray[Any]]:
    """Return the arrays that a function returns, or the one called ``error``."""
    module, _, name = function.partition(":")
    try:
        called = getattr(import_module(module), name)
        _limit(psutil.Process().memory_info().vms + memory)
        arrays: Mapping[str, NDArray[Any]] = called(*arguments)
    except MemoryError:
        arrays = {"error": np.array("content that takes more memory than a file of its size")}
    except Exception as error:  # whatever a library raises because of a damaged file
        arrays = {"error": np.array(f"{type(error).__name__}: {error}"[:300])}
    finally:
        _limit(resource.getrlimit(resource.RLIMIT_AS)[1])  # what the system allows
    return arrays


def _limit(memory: int) -> None:
    """Let this process take ``memory`` bytes of addresses."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (memory, hard))


if __name__ == "__main__":
    serve()
