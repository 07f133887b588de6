"""What fills a file where no model fills a trial gap in time, and where there are no trials."""

from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import LinearImputer
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.attempt import Attempt, attempt
from mocapbench.benchmark.filling.filler import BEST, fill
from mocapbench.benchmark.filling.requests.request import NamedEntries, select
from mocapbench.benchmark.filling.sources import Source
from mocapbench.benchmark.registry import MODELS
from mocapbench.datasets import CSVFormat


class Slow:
    """In place of workers: no model answers in less than a minute."""

    count = 1

    def keep(self, question):
        return question

    def submit(self, model, question, seconds, method="impute"):
        if seconds < 60.0:
            return Attempt(None, "was stopped", slow=True)
        return attempt(MODELS.get(model), question, 2**40, method)

    def ended(self, futures):
        return [*futures]

    def result(self, future):
        return future


def source(recording, mask):
    request = select(recording.hide(mask), NamedEntries())
    return Source(Path("waves.csv"), CSVFormat(), request, ())


def test_without_a_trial_in_time_an_interpolation_fills_the_file(waves, hidden):
    given = source(waves(), hidden((50, 60, [0, 1])))
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


def test_without_room_for_a_trial_a_model_is_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match="name a model with --model"):
        fill(source(waves(), mask), BEST, Slow(), 5.0, lambda *_: None)
