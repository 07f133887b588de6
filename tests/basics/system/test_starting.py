"""A signal reaches the main thread on every system."""

import signal
import threading
import time

import pytest

from mocapbench.basics.system.starting import strike_main_thread


class StruckError(Exception):
    pass


@pytest.fixture(autouse=True)
def handler():
    def strike(*_):
        raise StruckError

    before = signal.signal(signal.SIGTERM, strike)
    yield
    signal.signal(signal.SIGTERM, before)


def test_where_no_signal_can_be_sent_to_a_thread_it_is_still_handled(monkeypatch):
    monkeypatch.delattr(signal, "pthread_kill", raising=False)  # as on Windows
    threading.Timer(0.1, strike_main_thread, args=(signal.SIGTERM,)).start()
    with pytest.raises(StruckError):
        for _ in range(6000):
            time.sleep(0.01)


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="Windows cannot")
def test_a_signal_wakes_the_main_thread():
    began = time.monotonic()
    threading.Timer(0.1, strike_main_thread, args=(signal.SIGTERM,)).start()
    with pytest.raises(StruckError):
        time.sleep(60.0)
    assert time.monotonic() - began < 50.0
