"""The process in which `call_isolated` has functions called, one after another.

A request is a line of JSON; an answer is its length and an .npz file. The process ends with the
one that started it, whose end closes the pipe of requests.
"""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Mapping
from importlib import import_module
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.system.choice import find_system

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
        find_system().limit_growth(memory)
        arrays: Mapping[str, NDArray[Any]] = called(*arguments)
    except MemoryError:
        arrays = {"error": np.array("content that takes more memory than a file of its size")}
    except Exception as error:  # whatever a library raises because of a damaged file
        arrays = {"error": np.array(f"{type(error).__name__}: {error}"[:300])}
    finally:
        find_system().limit_memory(math.inf)
    return arrays


if __name__ == "__main__":
    serve()
