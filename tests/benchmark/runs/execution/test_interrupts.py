"""An interrupt waits for the end of what it must not break into, and then strikes."""

import itertools
import os
import signal
import sys
import threading
import time
from contextlib import contextmanager

import pytest

from mocapbench.benchmark.runs.execution.interrupts import interrupts_later
from mocapbench.benchmark.runs.execution.worker_pool import WorkerPool

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def _raise(_signal, _frame):
    raise KeyboardInterrupt


@pytest.fixture(autouse=True)
def handlers():
    """Have every signal that ends processes raise an interrupt, as a run has."""
    before = {number: signal.signal(number, _raise) for number in ENDING}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
def test_what_is_begun_is_ended_before_an_interrupt_strikes(number):
    done = []
    with pytest.raises(KeyboardInterrupt), interrupts_later():
        signal.raise_signal(number)
        done.append("the rest")
    assert done == ["the rest"]
    assert [signal.getsignal(each) for each in ENDING] == [_raise] * 3


def test_an_ignored_signal_stays_ignored():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with interrupts_later():
        signal.raise_signal(signal.SIGHUP)
    assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN


def test_an_error_within_is_raised_where_nothing_interrupts():
    with pytest.raises(ZeroDivisionError), interrupts_later():
        raise ZeroDivisionError
    assert signal.getsignal(signal.SIGINT) is _raise


def test_another_thread_changes_no_handler():
    seen = []

    def look():
        with interrupts_later():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=look)
    thread.start()
    thread.join()
    assert seen == [_raise]


@contextmanager
def _interrupted_at(step, number, reached):
    """Interrupt this thread at a step, counted over lines, calls and returns in the context."""
    passed = itertools.count()

    def trace(*_):
        if next(passed) == step:
            reached.append(step)
            signal.raise_signal(number)
        return trace

    sys.settrace(trace)
    try:
        yield
    finally:
        sys.settrace(None)


def _outcome(step, number, function):
    """Return whether a call of the function has such a step, and whether it was interrupted."""
    reached = []
    try:
        with _interrupted_at(step, number, reached):
            function()
    except KeyboardInterrupt:
        return True, True
    return bool(reached), False


def _in_time(function):
    """Return what a function returns, which must not wait for ever."""
    returned = []
    thread = threading.Thread(target=lambda: returned.append(function()), daemon=True)
    thread.start()
    thread.join(60)
    assert returned, f"{function} still waits"
    return returned[0]


def _strikes(number):
    """Return whether a signal has the effect that its handler has."""
    try:
        signal.raise_signal(number)
    except KeyboardInterrupt:
        return True
    return False


@pytest.mark.parametrize("number", ENDING, ids=lambda number: number.name)
def test_an_interrupt_at_any_step_leaves_workers_that_work_and_can_be_stopped(number):
    pool = WorkerPool(1)
    assert _in_time(lambda: pool.submit(os.getpid).result())
    n_struck = 0  # not always: Python passes over what is raised while it collects garbage
    for step in itertools.count():
        reached, struck = _outcome(step, number, lambda: pool.submit(os.getpid))
        if not reached:
            break
        n_struck += struck
        assert all(_strikes(each) for each in ENDING)
        assert _in_time(lambda: pool.submit(os.getpid))
    assert n_struck > 100
    assert _in_time(lambda: pool.submit(os.getpid).result())
    assert _in_time(lambda: pool.stop() is None)


def test_an_interrupt_while_jobs_run_does_not_wait_for_them():
    pool = WorkerPool(1)
    running = pool.submit(time.sleep, 600)
    threading.Timer(0.5, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        pool.wait_for_any([running])
    assert not running.done()
    pool.stop([running])
