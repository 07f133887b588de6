"""Laws of the memory that filling takes, relative to that of a recording."""

import tracemalloc
from dataclasses import replace

import joblib
import numpy as np
import pytest

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.filling.arrangement import arrange, arrange_entries, restore_entries
from mocapbench.benchmark.filling.fill_attempt import fill_problem
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.jumps import measure_edges
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import Recording

N_FRAMES, N_CHANNELS = 50_000, 30


@pytest.fixture(scope="module")
def problem():
    """Return a problem with a short gap in each channel."""
    values = np.random.default_rng(0).normal(size=(N_FRAMES, N_CHANNELS))
    hidden = np.zeros(values.shape, dtype=bool)
    for channel in range(N_CHANNELS):
        hidden[100 * channel + 50 : 100 * channel + 90, channel] = True
    names = [f"c{channel:02d}" for channel in reversed(range(N_CHANNELS))]
    given = Recording("long", np.arange(N_FRAMES) / 120, values, names, ["mm"] * N_CHANNELS)
    return GapProblem(given.hide(hidden), hidden)


def measure_peak(work):
    """Return the peak memory of a call, relative to that of the values of the recording."""
    tracemalloc.start()
    work()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak / (8 * N_FRAMES * N_CHANNELS)


def test_recordings_of_the_same_values_share_their_memory(problem):
    given = problem.given
    others = (
        replace(given, name="another"),
        given.select(given.channels),
        given.hide(np.zeros((1, 1), dtype=bool)),
    )
    assert all(np.shares_memory(one.values, given.values) for one in others)
    assert measure_peak(lambda: replace(given, name="another")) < 0.5


def test_a_recording_shares_nothing_that_can_change(problem):
    values = problem.given.values.copy()
    values.flags.writeable = False
    kept = replace(problem.given, values=values)
    values.flags.writeable = True
    values[0, 0] = 5.0
    assert kept.values[0, 0] == problem.given.values[0, 0]
    with pytest.raises(ValueError):
        replace(kept, name="another").values.flags.writeable = True


def test_an_attempt_takes_few_copies_of_the_recording(problem):
    assert measure_peak(lambda: fill_problem(LinearImputer, problem)) < 2.5


def test_workers_read_a_problem_from_the_file_that_all_share(problem, tmp_path):
    workers = Workers(1)
    workers._folder = tmp_path
    kept = []
    assert measure_peak(lambda: kept.append(workers.keep(problem))) < 1.1  # joblib takes 16 MB
    assert measure_peak(lambda: kept.append(joblib.load(kept[0], mmap_mode="r"))) < 0.5
    np.testing.assert_array_equal(kept[1].given.values, problem.given.values)
    with pytest.raises(ValueError):
        kept[1].given.values.flags.writeable = True


def test_names_of_models_are_arranged_entry_by_entry(problem):
    arranged, order = arrange(problem)
    names = np.full(int(problem.target.sum()), "a model with a long name")
    assert measure_peak(lambda: arrange_entries(names, arranged, order)) < 0.2
    assert measure_peak(lambda: restore_entries(names, arranged, order)) < 0.2


def test_edges_take_less_memory_than_the_recording(problem):
    filled = problem.given.with_values(np.nan_to_num(problem.given.values))
    assert measure_peak(lambda: measure_edges(filled, problem.target)) < 1.2
