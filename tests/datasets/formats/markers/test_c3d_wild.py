"""C3D files of laboratories, and files that are damaged."""

import random
import resource
import warnings
from pathlib import Path

import numpy as np
import pytest
from c3d_files import PROCESSORS, write_bytes

from mocapbench.benchmark.testing import damage_bytes
from mocapbench.datasets import C3DFormat, FormatError, Recording
from mocapbench.datasets.formats.markers.c3d_layout import find_layout
from mocapbench.datasets.formats.markers.c3d_parameters import read_parameters

C3D = C3DFormat()
WILD = [folder / "shared" / "wild" for folder in Path(__file__).parents]
FILES = sorted(path for folder in WILD for path in folder.glob("**/*.c3d"))
"""Of others; there are none in a clone of the repository alone."""
MEGABYTES = 300
"""More than reading needs, and less than a damaged count of anything would ask for."""


@pytest.mark.skipif(not FILES, reason="files of laboratories are not beside the repository")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_files_of_laboratories_are_read_and_no_other_byte_is_written(path, tmp_path):
    recording = C3D.read(path)
    filled = recording.with_values(np.where(recording.visible, recording.values, 1.0))
    out = tmp_path / "out.c3d"
    C3D.write(out, filled, like=path)
    again = C3D.read(out)
    assert np.array_equal(again.values[recording.visible], recording.values[recording.visible])
    parameters = read_parameters(path)
    layout = find_layout(path, parameters)
    before, after = layout.points(path, "r"), np.array(layout.points(out, "r"))
    hidden = ~recording.visible[:, ::3]
    after[hidden] = before[hidden]
    assert np.array_equal(after.view(np.uint8), np.array(before).view(np.uint8))
    one, two = path.read_bytes(), out.read_bytes()
    assert len(one) == len(two)
    assert one[: layout.start] == two[: layout.start]
    assert one[layout.end :] == two[layout.end :]


@pytest.mark.parametrize("computer", PROCESSORS)
@pytest.mark.parametrize("scale", [-1.0, 0.125])
def test_a_damaged_file_is_read_or_refused_within_little_memory(computer, scale, tmp_path):
    rng = random.Random(f"{computer} {scale}")
    path = write_bytes(tmp_path / "given.c3d", np.ones((40, 5, 3)), computer, scale)
    data, before = path.read_bytes(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(200):
        path.write_bytes(damage_bytes(data, rng))
        with warnings.catch_warnings(action="ignore"):
            try:
                assert isinstance(C3D.read(path), Recording)
            except FormatError as error:
                assert all((error.expected, error.got, error.advice))
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < MEGABYTES * 1024
