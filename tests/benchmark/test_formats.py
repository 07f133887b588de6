"""What is measured of a file, by which models are compared: as much as `fill` fills."""

import numpy as np
import pytest
from c3d_files import text, write_bytes
from format_files import markers, write_trc

from mocapbench.benchmark.formats import format_for, read_measured
from mocapbench.benchmark.task_files.grouping import largest_group
from mocapbench.benchmark.task_files.library import FolderLibrary
from mocapbench.datasets import FormatWarning

LABELS = ["LKNE", "*12", "RKNE", "LFEO", "Force"]


def recorded(path, seed=0, labels=LABELS):
    """Write points that move, of which two are markers with names."""
    values = np.random.default_rng(seed).uniform(-9, 9, (40, 5, 3)).cumsum(axis=0)
    parameters = {"POINT:FORCES": text("Force"), "POINT:LABELS": text(*labels)}
    return write_bytes(path, values, labels=[], parameters=parameters)


@pytest.mark.parametrize(
    "read",
    [
        read_measured,
        lambda path: FolderLibrary(path.parent).recording(path.name),
    ],
)
def test_results_and_strays_are_left_out(tmp_path, read):
    path = recorded(tmp_path / "a.c3d")
    assert len(format_for(path).read(path).channels) == 15
    assert read(path).channels == ("LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "RKNE.y", "RKNE.z")
    assert FolderLibrary(tmp_path).digest("a.c3d")


def test_a_file_that_has_nothing_else_is_read_whole(tmp_path):
    path = recorded(tmp_path / "a.c3d", labels=["*1", "*2", "LFEO", "LFEA", "Force"])
    assert len(read_measured(path).channels) == 15


def test_files_whose_strays_and_results_differ_are_alike(tmp_path):
    recorded(tmp_path / "a.c3d")
    recorded(tmp_path / "b.c3d", 1, ["LKNE", "New 0001", "RKNE", "LTIO", "Force"])
    assert largest_group(tmp_path, None) == (("a.c3d", "b.c3d"), ())


def test_values_that_stand_for_missing_ones_are_hidden_with_a_word(tmp_path):
    moving = markers(40)
    values = moving.values.copy()
    values[20:30, 3:6] = 0.0
    write_trc(tmp_path / "a.trc", moving.with_values(values))
    with pytest.warns(FormatWarning, match="a.trc: lowerback is exactly 0, 0, 0 in 10 frames, far"):
        read = read_measured(tmp_path / "a.trc")
    assert (~read.visible).sum() == 30
