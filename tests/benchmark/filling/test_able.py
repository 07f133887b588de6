import numpy as np
import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.able import able_models, require_able
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.datasets import Recording

FIRST_TO_LAST = ("pchip", "rigid-body", "channel-kriging", "lds", "mohgp", "best-of")


def question(channels):
    values = np.zeros((9, len(channels)))
    recording = Recording("r", np.arange(9.0), values, channels, ("cm",) * len(channels))
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[3:5, 0] = True
    return GapQuestion(recording.hide(hidden), hidden)


def test_models_of_markers_are_tried_on_markers_alone():
    markers = question(("LKNE.x", "LKNE.y", "LKNE.z", "force"))
    assert "rigid-body" in able_models(markers)
    require_able("rigid-body", markers)
    angles = question(("LKNE.x", "LKNE.y", "hip"))
    assert "rigid-body" not in able_models(angles)
    with pytest.raises(UsageError, match=r"--model: expected a model that fills.*'rigid-body'"):
        require_able("rigid-body", angles)


def test_models_that_need_a_process_are_never_tried():
    assert not {"oracle", "control"} & set(able_models(question(("LKNE.x", "LKNE.y", "LKNE.z"))))


def test_models_are_tried_the_sooner_the_less_they_take_or_the_more_they_are_made_for_it():
    names = able_models(question(("LKNE.x", "LKNE.y", "LKNE.z", "force")))
    turns = [names.index(name) for name in FIRST_TO_LAST]
    assert turns == sorted(turns)
    assert names[-1] == "best-of"
    assert {"marker-kriging", "rigid-body"} == {*names[turns[1] - 1 : turns[1] + 1]}
