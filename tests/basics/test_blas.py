"""BLAS has one thread while a model computes, and the caller's number before and after."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Event

import pytest
from threadpoolctl import ThreadpoolController, threadpool_info, threadpool_limits

from mocapbench.baselines import FrameImputer, Imputer, Interpolator, Model, Synthesiser
from mocapbench.basics import blas
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.testing.subject import GAP, TIMES, Subject, problem

CALLERS = 2


def n_threads():
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def number_of_the_caller():
    """Let BLAS have two threads around a test, whatever the computer has."""
    with threadpool_limits(CALLERS, user_api="blas"):
        assert n_threads() == {CALLERS}
        yield
        assert n_threads() == {CALLERS}


class Watched(list):
    """Recordings that note how many threads BLAS has when a model reads them."""

    def __init__(self, recordings):
        super().__init__(recordings)
        self.seen = set()

    def __iter__(self):
        self.seen |= n_threads()
        return super().__iter__()


class WatchedTimes:
    """Times that note the same when a model makes an array of them."""

    def __init__(self):
        self.seen = set()

    def __array__(self, dtype=None, copy=None):
        self.seen |= n_threads()
        return TIMES.astype(dtype)


class Unreadable(list):
    """Recordings that fail when a model reads them."""

    def __iter__(self):
        raise MemoryError


@pytest.mark.parametrize("name", MODELS.names())
def test_a_registered_model_has_one_thread_in_every_ability(name):
    recordings = Watched(problem(GAP))
    model = Subject(MODELS.get(name)).fit_model(recordings)
    assert recordings.seen == {1}
    assert n_threads() == {CALLERS}
    if isinstance(model, FrameImputer):
        recordings.seen.clear()
        model.impute(recordings)
        assert recordings.seen == {1}
    if isinstance(model, Synthesiser):
        times = WatchedTimes()
        model.sample(times, 2, random_state=0)
        assert times.seen == {1}


@pytest.mark.parametrize("name", MODELS.names())
def test_the_callers_number_is_back_after_a_registered_model_failed(name):
    with pytest.raises(MemoryError):
        Subject(MODELS.get(name)).fit_model(Unreadable(problem(GAP)))
    assert n_threads() == {CALLERS}


class MixIn:
    """What a package of somebody else may share among its models."""

    def impute(self, recordings):
        return self.compute(recordings)


class Plugged(MixIn, Imputer):
    def __init__(self, compute=None):
        self.compute = compute

    def fit(self, recordings):
        return self


class Derived(Plugged):
    def impute(self, recordings):
        return super().impute(recordings)


@pytest.mark.parametrize("kind", [Plugged, Derived])
def test_a_model_of_somebody_else_has_one_thread_in_methods_of_mix_ins_too(kind):
    assert kind(lambda recordings: n_threads()).impute([]) == {1}


def test_a_model_within_a_model_leaves_the_limit_to_the_outer_one():
    inner = Plugged(lambda recordings: None)
    assert Plugged(lambda recordings: (inner.impute([]), n_threads())[1]).impute([]) == {1}


def test_a_limited_method_keeps_its_name_documentation_and_abstractness():
    assert Plugged.impute.__qualname__ == "MixIn.impute"
    assert FrameImputer.impute.__doc__.startswith("Return one prediction")
    with pytest.raises(TypeError, match="abstract"):
        Interpolator()
    assert Model.get_params(Plugged(3)) == {"compute": 3}


def test_models_in_threads_that_overlap_restore_the_number_when_the_last_is_done():
    """The second begins within the first and ends after it."""
    begun, ended = Event(), Event()

    def outlast(recordings):
        begun.set()
        assert ended.wait(60)
        return n_threads()

    def overtake(recordings):
        second = pool.submit(Plugged(outlast).impute, [])
        assert begun.wait(60)
        return second

    with ThreadPoolExecutor(1) as pool, ThreadPoolExecutor(1) as first_pool:
        second = first_pool.submit(Plugged(overtake).impute, []).result()
        ended.set()
        assert second.result() == {1}
        assert n_threads() == {CALLERS}


def test_a_library_that_is_loaded_within_a_call_is_limited_by_the_next_one(monkeypatch):
    everything = ThreadpoolController()
    known = [everything.select(user_api="none yet"), everything]
    monkeypatch.setattr(blas, "get_cached_controller", lambda: known[0])

    def load(recordings):
        known.pop(0)
        return Plugged(lambda recordings: n_threads()).impute([])

    assert Plugged(load).impute([]) == {1}


def test_a_thread_that_a_limit_was_set_in_stays_free_to_set_another():
    Plugged(lambda recordings: None).impute([])
    with ThreadPoolExecutor(1) as pool:
        pool.submit(threadpool_limits, 1).result()
        assert n_threads() == {1}
        pool.submit(threadpool_limits, CALLERS).result()


def test_a_script_that_says_nothing_of_threads_computes_with_one(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import numpy as np\n"
        "from threadpoolctl import threadpool_info, threadpool_limits\n"
        "from mocapbench.baselines import Imputer\n"
        "def show(): print({i['num_threads'] for i in threadpool_info()"
        " if i['user_api'] == 'blas'})\n"
        "class Shown(Imputer):\n"
        "    def fit(self, recordings): return self\n"
        "    def impute(self, recordings): show()\n"
        "threadpool_limits(2)\n"
        "show(); Shown().fit([]).impute([]); show()\n"
    )
    shown = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert shown.stdout.split() == ["{2}", "{1}", "{2}"]
