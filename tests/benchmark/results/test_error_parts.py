"""Errors along gaps and by joint, taken from the parts of records."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark import TASKS, Address, Record, Status, archive_at, error_parts
from mocapbench.benchmark.results.error_parts import N_PLACES, along_gap

TASK = TASKS.get("missing-frames")
CASE = next(case.name for case in TASK.cases if case.synthetic)
N_JOINTS = 31


def _record(fold, label, errors, joints):
    address = Address(TASK.name, TASK.version, CASE, fold, label)
    fields = {"key": f"{label}{fold}", "fit_key": label, "seed": 0, "model": label}
    parts = {"rms_per_frame": {"frame": errors}, "mpjpe": {"joint": joints}}
    return Record(**fields, parameters={}, address=address, status=Status.OK, parts=parts)


@given(
    before=st.integers(0, 9),
    length=st.integers(1, 60),
    after=st.integers(0, 9),
    ends=st.tuples(st.floats(0, 9), st.floats(0, 9)),
)
def test_a_straight_course_stays_straight_at_any_length(before, length, after, ends):
    nan = np.full(before + after, np.nan)
    errors = np.insert(nan, before, np.linspace(*ends, length))
    found = along_gap(errors)
    if before == 0 or after == 0 or length < 8:
        assert found == []
    else:
        (course,) = found
        assert len(course) == N_PLACES
        assert np.ptp(np.diff(course, 2)) < 0.2 * np.ptp(ends) + 1e-5
        assert min(ends) - 1e-5 <= course.min() <= course.max() <= max(ends) + 1e-5


def test_windows_are_stacked_and_joints_averaged_over_folds():
    gap = [None, *[1.0] * 10, None]
    records = [
        _record(0, "knn", gap, [1.0] * 30 + [None]),
        _record(1, "knn", gap, [3.0] * 30 + [None]),
        _record(0, "nn", [None] * 12, [2.0] * N_JOINTS),
    ]
    parts = error_parts(records, archive_at())
    cell = (TASK.name, CASE, "knn")
    assert parts.metrics == {TASK.name: "rms_per_frame"}
    assert {key: windows.shape for key, windows in parts.along_gap.items()} == {cell: (2, 20)}
    assert parts.by_joint[cell][:30] == pytest.approx(2.0)
    assert np.isnan(parts.by_joint[cell][30])


def test_the_body_is_that_of_a_recording_with_as_many_joints():
    whole = [_record(0, "knn", [1.0], [1.0] * N_JOINTS)]
    pose = error_parts(whole, archive_at()).rest_poses[TASK.name]
    assert len(pose) == N_JOINTS
    assert np.ptp(pose["y"]) > 100.0  # it stands upright, in centimetres
    fewer = [_record(0, "knn", [1.0], [1.0] * 5)]
    assert error_parts(fewer, archive_at()).rest_poses == {}
