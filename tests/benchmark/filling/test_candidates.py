import numpy as np
import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.candidates import find_candidates, require_candidate
from mocapbench.benchmark.filling.costs import predict_seconds
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import build_unfitted
from mocapbench.datasets import Recording


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


MARKERS = problem(("LKNE.x", "LKNE.y", "LKNE.z", "force"))


def test_interpolations_come_first_then_what_is_most_promising_then_others_by_their_work():
    names = find_candidates(MARKERS)
    interpolating = [n for n in names if "interpolates" in build_unfitted(n).provides]
    assert interpolating
    promising = ["marker-kriging", "rigid-body", "channel-kriging", "lds"]
    first = [*interpolating, *promising]
    assert [*names[: len(first)]] == first
    seconds = [predict_seconds(name, MARKERS) for name in names[len(first) :]]
    assert seconds == sorted(seconds)
    assert len(names) == len({*names})


def test_joints_have_pose_kriging_among_the_most_promising():
    hidden = np.zeros((9, 2), dtype=bool)
    hidden[3:5] = True
    whole = Recording("r", np.arange(9.0), np.zeros((9, 2)), ("hip.rx", "hip.ry"), ("deg", "deg"))
    names = find_candidates(GapProblem(whole.hide(hidden), hidden))
    promising = [name for name in names if name in {"pose-kriging", "channel-kriging", "lds"}]
    assert promising == ["pose-kriging", "channel-kriging", "lds"]
