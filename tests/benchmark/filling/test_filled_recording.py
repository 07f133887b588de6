"""What fills a file where no model fills a held-out gap in time, or nothing can be held out."""

from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.fill_attempt import FillAttempt, attempt_fill
from mocapbench.benchmark.filling.filled_file import BEST, fill
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.requests.request import NamedEntries, select
from mocapbench.benchmark.registry import MODELS, find_calibration
from mocapbench.datasets import CSVFormat


class Slow:
    """In place of workers: no model fills anything in less than a minute."""

    count = 1

    def keep(self, problem):
        return problem

    def submit(self, model, problem, seconds, method="impute"):
        if seconds < 60.0:
            return FillAttempt(None, "was stopped", timed_out=True)
        return attempt_fill(MODELS.get(model), problem, 2**40, method, find_calibration(model))

    def wait_for_any(self, futures):
        return [*futures]

    def collect(self, future):
        return future


def input_file(recording, mask):
    request = select(recording.hide(mask), NamedEntries())
    return InputFile(Path("waves.csv"), CSVFormat(), request, ())


def test_without_a_hold_out_in_time_an_interpolation_fills_the_file(waves, hidden):
    given = input_file(waves(), hidden((50, 60, [0, 1])))
    told = []
    filled = fill(given, BEST, Slow(), 5.0, lambda *counts: told.append(counts))
    assert (filled.model, filled.uncompared, filled.choice) == ("linear", True, None)
    assert told
    assert {done for done, _ in told} == {0}
    request = given.request
    (line,) = LinearImputer().fit([request.given]).impute([request.given])
    np.testing.assert_array_equal(
        filled.recording.values[request.target], line.mean[request.target]
    )


def test_without_room_for_a_hold_out_a_model_is_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match="name a model with --model"):
        fill(input_file(waves(), mask), BEST, Slow(), 5.0, lambda *_: None)


def test_a_model_is_not_asked_about_frames_in_which_nobody_is_there(waves, hidden):
    everything = [0, 1, 2, 3]
    mask = hidden(
        (0, 30, everything), (50, 60, [0, 1]), (70, 80, everything), (190, 200, everything)
    )
    problem = input_file(waves(), mask).problem
    np.testing.assert_array_equal(problem.given.times, waves().times[30:190])
    np.testing.assert_array_equal(problem.target, mask[30:190])


def test_entries_are_filled_at_their_frames_though_frames_before_them_are_cut(waves, hidden):
    mask = hidden((0, 30, [0, 1, 2, 3]), (50, 60, [0, 1]))
    filled = fill(input_file(waves(), mask), "linear", Slow(), 5.0, lambda *_: None)
    (line,) = LinearImputer().fit([waves()]).impute([waves().hide(mask)])
    np.testing.assert_allclose(filled.recording.values[50:60, :2], line.mean[50:60, :2])
    assert not filled.recording.visible[:30].any()
