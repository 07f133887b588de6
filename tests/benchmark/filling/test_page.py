"""The page of a filled file: which figures of its motion are filled."""

import format_files
import numpy as np
import pytest

from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.page import page_of
from mocapbench.benchmark.filling.question import Answer
from mocapbench.benchmark.filling.request import Request
from mocapbench.benchmark.filling.sources import Source
from mocapbench.datasets import AcclaimFormat


@pytest.mark.parametrize("length", [1, 2, 4, 5, 12, 30])
@pytest.mark.parametrize("start", [0, 1, 20])
def test_figures_show_filled_frames_and_frames_of_the_file_beside_them(tmp_path, start, length):
    walk, path = format_files.walk(), tmp_path / "walker.amc"
    format_files.write_acclaim(path, walk)
    target = np.zeros(walk.values.shape, dtype=bool)
    target[start : start + length, 10] = True
    source = Source(path, AcclaimFormat(), Request(walk.hide(target), target, ()), ())
    answer = Answer(walk.values[target], np.ones(length))
    panel = page_of(Filled(source, "one", answer, 0, None, ()), "mocapbench fill").motion
    groups = [curve.group for curve in panel.curves]
    assert {*groups} == {"filled", "in the file"}
    assert groups[-1] == "in the file"
    assert (groups[0] == "filled") == (start == 0)
