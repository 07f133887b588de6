"""The time of a job is up for both of its processes."""

import math
import os
import signal
import time
from contextlib import suppress

import pytest

from mocapbench.basics.child import ProcessDiedError, call_in_child
from mocapbench.benchmark.runs.execution.time_limit import TimeLimit

pytestmark = pytest.mark.forks


def _timer():
    return signal.getitimer(signal.ITIMER_REAL)[0]


def _sleep_within(seconds):
    with TimeLimit(seconds):
        time.sleep(600)


def _sleep_after_a_child(seconds):
    with TimeLimit(seconds) as limit:
        limit.call_in_child(time.sleep, 0.01)
        time.sleep(600)


@pytest.mark.parametrize("work", [_sleep_within, _sleep_after_a_child])
def test_this_process_is_killed_when_the_time_is_up(work):
    with pytest.raises(ProcessDiedError) as caught:
        call_in_child(work, 0.3, timeout=60)
    assert caught.value.exit_code == -signal.SIGALRM


def test_the_child_has_the_time_that_is_left_and_no_timer_of_its_own():
    with TimeLimit(60) as limit:
        assert 0 < _timer() <= 60
        assert limit.call_in_child(_timer) == 0
        assert 0 < _timer() <= 60
    assert _timer() == 0


def test_a_child_that_takes_too_long_is_killed_and_this_process_goes_on():
    with pytest.raises(TimeoutError), TimeLimit(0.3) as limit:
        limit.call_in_child(time.sleep, 600)
    assert _timer() == 0
    time.sleep(0.4)  # a timer that runs on would end this process


def test_no_timer_runs_after_a_child_that_died():
    with suppress(ProcessDiedError), TimeLimit(60) as limit:
        limit.call_in_child(os._exit, 7)
    assert _timer() == 0


@pytest.mark.parametrize("seconds", [3e6, 1e9, 1e300, math.inf])
def test_no_time_is_too_long(seconds):
    with TimeLimit(seconds) as limit:
        assert limit.call_in_child(abs, -3) == 3
        assert _timer() > 1e6
    assert call_in_child(abs, -3, timeout=seconds) == 3
