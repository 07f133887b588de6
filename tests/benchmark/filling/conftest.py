from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.ranking import rank
from mocapbench.benchmark.filling.filled_file import FilledFile
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.requests.request import FillRequest
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

    def make(choice=None, *, left_open=(), n_windows=0, failed=()):
        target = hidden((50, 60, [0, 1]))
        request = FillRequest(waves().hide(target), target, left_open)
        prediction = PredictedEntries(waves().values[target], np.ones(20))
        input_file = InputFile(Path("waves.csv"), CSVFormat(), request, ())
        return FilledFile(input_file, "one", prediction, n_windows, choice, failed)

    return make


@pytest.fixture
def choice_of():
    """Return a function from the errors of models in held-out gaps to the choice among them."""

    def make(errors, share=1.0, positions=None):
        errors = {model: np.array(each, dtype=float) for model, each in errors.items()}
        n = len(next(iter(errors.values())))
        at = np.arange(n) if positions is None else np.array(positions)
        rmse = {model: {"deg": 1.0} for model in errors}
        seconds, n_windows = dict.fromkeys(errors, 0.1), dict.fromkeys(errors, 2)
        ranking = rank(errors, np.ones(n), at)
        return Choice(ranking, (), share, rmse, frozenset(), seconds, n_windows)

    return make
