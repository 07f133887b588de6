import pytest

from mocapbench.benchmark import TASKS, archive_at

TASK = TASKS.get("walking-interpolation")


@pytest.mark.parametrize("case", TASK.cases, ids=lambda case: case.name)
def test_as_many_frames_of_each_channel_are_visible_as_the_case_says(posed, case):
    if not all(map(archive_at().available, case.given)):
        pytest.skip("MOCAPBENCH_DATA names no recordings")
    (given,) = posed(TASK.name, case.name, 1).given
    assert given.values.shape == (90, 39)
    assert (given.visible.sum(axis=0) == case.columns["visible frames"]).all()
