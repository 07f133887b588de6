import numpy as np
import pytest

from mocapbench.benchmark.filling.requests.zeros import describe_zeros
from mocapbench.datasets import Recording

FRAMES = np.arange(10.0)
MOVING = np.column_stack([FRAMES - 20, 5 * FRAMES, FRAMES + 900])


def marker(values, unit="mm"):
    channels = ["RKNE.x", "RKNE.y", "RKNE.z"]
    return Recording("walk", FRAMES, values, channels, [unit] * 3)


@pytest.mark.parametrize(("missing", "said"), [([4], "1 frame "), ([0, 1, 7], "3 frames ")])
def test_a_marker_that_is_zero_in_some_frames_and_moves_in_others_is_named(missing, said):
    values = MOVING.copy()
    values[missing] = 0.0
    caution = describe_zeros(marker(values))
    assert caution.startswith(f"RKNE is exactly 0, 0, 0 in {said}")
    assert caution.endswith("if that marks missing values, empty these cells.")


@pytest.mark.parametrize("values", [MOVING, MOVING * [1, 0, 1], MOVING * 0.0, MOVING * np.nan])
def test_markers_that_never_or_always_are_at_the_origin_are_not(values):
    assert describe_zeros(marker(values)) == ""


def test_angles_may_be_zero():
    values = MOVING.copy()
    values[3] = 0.0
    assert describe_zeros(marker(values, unit="deg")) == ""


def test_the_most_frames_of_several_markers_are_said():
    values = np.hstack([MOVING, MOVING])
    values[:2, :3], values[5:, 3:] = 0.0, 0.0
    channels = [f"{name}.{axis}" for name in ("LKNE", "RKNE") for axis in "xyz"]
    two = Recording("walk", FRAMES, values, channels, ["mm"] * 6)
    assert describe_zeros(two).startswith("LKNE and RKNE are exactly 0, 0, 0 in up to 5 frames")
