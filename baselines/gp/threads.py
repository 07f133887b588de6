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

from threadpoolctl import threadpool_limits

__all__ = ["Mapper", "thread_mapper"]

T = TypeVar("T")
U = TypeVar("U")


class Mapper(Protocol):
    """A function with the signature of the builtin ``map`` for one iterable."""

    def __call__(self, function: Callable[[T], U], items: Iterable[T], /) -> Iterable[U]:
        """Return the function of every item, in order."""


@contextmanager
def thread_mapper(n_threads: int) -> Iterator[Mapper]:
    """Give a mapper over ``n_threads`` threads, and limit BLAS to one thread meanwhile.

    numpy and scipy each bring a pool of BLAS threads. On matrices this small and few cores, two
    pools of spinning threads cost more than they gain. The limit is set once, not for each call.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        if n_threads == 1:
            yield map
            return
        with ThreadPoolExecutor(n_threads) as pool:
            yield pool.map
