import numpy as np
import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates, require_candidate
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.datasets import Recording

FIRST_TO_LAST = ("pchip", "rigid-body", "channel-kriging", "lds", "mohgp", "best-of")


def problem(channels):
    values = np.zeros((9, len(channels)))
    recording = Recording("r", np.arange(9.0), values, channels, ("cm",) * len(channels))
    hidden = np.zeros(values.shape, dtype=bool)
    hidden[3:5, 0] = True
    return GapProblem(recording.hide(hidden), hidden)


def test_models_of_markers_are_candidates_for_markers_alone():
    markers = problem(("LKNE.x", "LKNE.y", "LKNE.z", "force"))
    assert "rigid-body" in find_candidates(markers)
    require_candidate("rigid-body", markers)
    angles = problem(("LKNE.x", "LKNE.y", "hip"))
    assert "rigid-body" not in find_candidates(angles)
    with pytest.raises(UsageError, match=r"--model: expected a model that fills.*'rigid-body'"):
        require_candidate("rigid-body", angles)


def test_models_that_need_a_process_are_no_candidates():
    assert not {"oracle", "control"} & set(find_candidates(problem(("LKNE.x", "LKNE.y", "LKNE.z"))))


def test_models_start_the_sooner_the_less_they_take_or_the_more_they_are_made_for_it():
    names = find_candidates(problem(("LKNE.x", "LKNE.y", "LKNE.z", "force")))
    starts = [names.index(name) for name in FIRST_TO_LAST]
    assert starts == sorted(starts)
    assert names[-1] == "best-of"
    assert {"marker-kriging", "rigid-body"} == {*names[starts[1] - 1 : starts[1] + 1]}
