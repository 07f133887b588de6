"""One thread of BLAS while a model computes.

The matrices of models are small: threads of BLAS gain nothing on them, and each spins on a
processor while it waits for the others. `Model` limits the public methods of every subclass by
`limit_blas`, so that the author of a model writes nothing about it.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from functools import wraps
from threading import Lock
from typing import Any, TypeVar

from threadpoolctl import OpenBLASController, ThreadpoolController, get_cached_controller

__all__ = ["limit_blas"]

T = TypeVar("T")


def limit_blas(method: Callable[..., T]) -> Callable[..., T]:
    """Return a method during whose calls BLAS has one thread; then the caller's number is back."""

    @wraps(method)
    def call_on_one_thread(*args: Any, **keywords: Any) -> T:
        with _ONE_THREAD:
            return method(*args, **keywords)

    return call_on_one_thread


class _OneThread:
    """The limit that all calls of this process share, nested ones and those of other threads.

    OpenBLAS has one number for the whole process. The first call sets it and the last one to end
    restores it: calls that overlap in time cannot each restore what they found.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._n_calls = 0
        self._limited: ThreadpoolController | None = None
        self._originals = ExitStack()

    def __enter__(self) -> None:
        with self._lock:
            # It is another one once modules have been imported, which may bring another BLAS.
            controller = get_cached_controller()
            if controller is not self._limited:
                self._limit(controller)
            self._n_calls += 1

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._n_calls -= 1
            if self._n_calls == 0:
                _set_from_this_thread(self._originals.close)
                self._limited = None

    def _limit(self, controller: ThreadpoolController) -> None:
        libraries = controller.select(user_api="blas")
        limit = _set_from_this_thread(lambda: libraries.limit(limits=1))
        self._originals.callback(limit.restore_original_limits)
        self._limited = controller


_ONE_THREAD = _OneThread()


def _set_from_this_thread(change: Callable[[], T]) -> T:
    """Change numbers of threads from whichever thread this is.

    threadpoolctl ignores all but the first thread that sets the number of OpenBLAS, until it is
    told that the first one is done.
    """
    OpenBLASController.clear_controlling_thread(force=True)
    try:
        return change()
    finally:
        OpenBLASController.clear_controlling_thread(force=True)
