"""Threads over outputs.

The solvers do the same small factorisation for every output. A solver takes a *mapper*: the
builtin ``map``, or one that shares the calls out between threads. Results come in order and each
is computed by one thread, so that they do not depend on the number of threads.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Protocol, TypeVar

from threadpoolctl import threadpool_limits

__all__ = ["Mapper", "mapping"]

T = TypeVar("T")
U = TypeVar("U")


class Mapper(Protocol):
    """Calls like the builtin ``map``."""

    def __call__(self, function: Callable[[T], U], items: Iterable[T], /) -> Iterable[U]:
        """Return the function of every item, in order."""


@contextmanager
def mapping(n_threads: int) -> Iterator[Mapper]:
    """Give a mapper over ``n_threads`` threads, and BLAS one thread meanwhile.

    The wheels of numpy and scipy carry a pool of BLAS threads each. Two spinning pools on few
    cores cost more than they gain on matrices this small; the limit is set once, not per call.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        if n_threads == 1:
            yield map
            return
        with ThreadPoolExecutor(n_threads) as pool:
            yield pool.map
