import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.halving import Contender
from mocapbench.benchmark.filling.choosing.hold_outs import HeldOutGap, HoldOut
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.ranking import rank
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.requests.request import BEST, FillRequest
from mocapbench.datasets import Recording

CHANNELS = ("hip.rx", "hip.ry", "knee.rx", "root.ty")
UNITS = ("deg", "deg", "deg", "cm")
KIND = Kind("deg", "one marker or joint", "up to 0.25 s")


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
    """Return a function from what is special to a filled recording; ``one`` filled all."""

    def make(choice=None, request=None, mean=None, *, variance=1.0, n_windows=0, **special):
        target = hidden((50, 60, [0, 1])) if request is None else request.target
        n = int(target.sum())
        mean = waves().values[target] if mean is None else np.full(n, mean)
        return FilledRecording(
            request or request_of(waves(), target, special.pop("left_open", ())),
            PredictedEntries(mean, None if variance is None else np.full(n, variance)),
            np.full(n, "one"),
            np.zeros(n, dtype=int),
            (KIND,),
            choice,
            special.pop("failed", {}),
            {"one": n_windows},
            **special,
        )

    return make


def request_of(whole, target, left_open=()):
    models = np.full(int(target.sum()), BEST)
    return FillRequest(whole.hide(target), target, models, left_open=left_open)


@pytest.fixture
def choice_of():
    """Return a function from the errors of models in held-out gaps to the choice among them."""

    def make(errors, share=1.0, positions=None):
        errors = {model: np.array(each, dtype=float) for model, each in errors.items()}
        n = len(next(iter(errors.values())))
        at = np.arange(n) if positions is None else np.array(positions)
        copy, original = Gap(0, round(20 * share), (0,)), Gap(100, 120, (0,))
        hold_out = HoldOut(None, None, (HeldOutGap(KIND, copy, original, np.arange(1)),))
        contenders = (Contender(model, [None], n_windows=2) for model in errors)
        return Choice({KIND: rank(errors, np.ones(n), at)}, (hold_out,), tuple(contenders))

    return make
