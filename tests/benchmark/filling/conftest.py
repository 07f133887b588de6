from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.question import FilledEntries
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.benchmark.filling.sources import Source
from mocapbench.benchmark.filling.trials.comparison import Choice
from mocapbench.benchmark.filling.trials.ranking import rank
from mocapbench.benchmark.filling.trials.scores import TrialScores
from mocapbench.datasets import CSVFormat, Recording

CHANNELS = ("hip.rx", "hip.ry", "knee.rx", "root.ty")
UNITS = ("deg", "deg", "deg", "cm")


@pytest.fixture
def waves():
    """Return a function from a number of frames to a recording of four smooth channels."""

    def make(n_frames=200, name="waves"):
        times = np.arange(n_frames) / 50
        phases = np.arange(4) * 0.7
        values = 20 * np.sin(2 * np.pi * times[:, None] * [1.0, 1.0, 2.0, 0.5] + phases)
        return Recording(name, times, values, CHANNELS, UNITS)

    return make


@pytest.fixture
def hidden():
    """Return a function from blocks (first, stop, channels) to a mask of 200 frames."""

    def make(*blocks, n_frames=200):
        mask = np.zeros((n_frames, 4), dtype=bool)
        for first, stop, channels in blocks:
            mask[first:stop, channels] = True
        return mask

    return make


@pytest.fixture
def filled(waves, hidden):
    """Return a function from what is special to a filled file."""

    def make(choice=None, *, left_open=(), windows=0, failed=()):
        target = hidden((50, 60, [0, 1]))
        request = FillRequest(waves().hide(target), target, left_open)
        answer = FilledEntries(waves().values[target], np.ones(20))
        source = Source(Path("waves.csv"), CSVFormat(), request, ())
        return Filled(source, "one", answer, windows, choice, failed)

    return make


@pytest.fixture
def choice_of():
    """Return a function from the errors of models in trial gaps to the choice among them."""

    def make(errors, share=1.0, places=None):
        scores = {
            model: TrialScores(np.array(of_model, dtype=float), {"deg": 1.0}, has_bands=False)
            for model, of_model in errors.items()
        }
        n = len(next(iter(errors.values())))
        ranking = rank(scores, np.ones(n), np.arange(n) if places is None else np.array(places))
        seconds = dict.fromkeys(errors, 0.1)
        return Choice(ranking, (), share, seconds, dict.fromkeys(errors, 2))

    return make
