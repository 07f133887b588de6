"""Threads over outputs.

The solvers do the same small factorisation for every output. A solver takes a *mapper*: the
builtin ``map``, or one that distributes the calls over threads. Each result is computed by one
thread and results come in order, so that they do not depend on the number of threads.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Protocol, TypeVar

__all__ = ["Mapper", "thread_mapper"]

T = TypeVar("T")
U = TypeVar("U")


class Mapper(Protocol):
    """A function with the signature of the builtin ``map`` for one iterable."""

    def __call__(self, function: Callable[[T], U], items: Iterable[T], /) -> Iterable[U]:
        """Return the function of every item, in order."""


@contextmanager
def thread_mapper(n_threads: int) -> Iterator[Mapper]:
    """Give a mapper over ``n_threads`` threads."""
    if n_threads == 1:
        yield map
        return
    with ThreadPoolExecutor(n_threads) as pool:
        yield pool.map
