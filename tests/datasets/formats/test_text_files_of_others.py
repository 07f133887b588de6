"""TRC and BVH files of laboratories, of makers of software, and of public reports of errors."""

import numpy as np
import pytest
from shared_files import shared_like

from mocapbench.benchmark.formats import format_for

FILES = [*shared_like("wild/**/*.trc"), *shared_like("wild/**/*.bvh")]
NEW = 1234567.5


@pytest.mark.skipif(not FILES, reason="files of laboratories are not beside the repository")
@pytest.mark.filterwarnings("ignore:.* expected .* which are read")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_every_file_is_read_and_no_other_character_is_written(path, tmp_path):
    file = format_for(path)
    recording, out = file.load(path, None), tmp_path / f"out{path.suffix}"
    file.write(out, recording, path)
    assert out.read_bytes() == path.read_bytes()
    new = np.random.default_rng(0).random(recording.values.shape) < 0.2
    units = ("", *[unit for unit in recording.units if unit not in {"deg", "rad"}])
    new[:, [unit not in units for unit in recording.units]] = False
    file.write(out, recording.with_values(np.where(new, NEW, recording.values)), path, new)
    again = file.load(out, None)
    assert np.array_equal(again.values[~new], recording.values[~new], equal_nan=True)
    assert (again.values[new] == NEW).all()
    before, after = (one.read_bytes().decode("latin-1").splitlines() for one in (path, out))
    start = len(before) - len([line for line in before if line[:1].isdigit()])
    assert before[: min(start, 5)] == after[: min(start, 5)]


TRC = [path for path in FILES if path.suffix == ".trc"]


@pytest.mark.skipif(not TRC, reason="files of laboratories are not beside the repository")
@pytest.mark.filterwarnings("ignore:.* expected .* which are read")
@pytest.mark.parametrize("path", TRC, ids=lambda path: path.name)
def test_another_reader_finds_the_same_positions(path, tmp_path):
    trc = pytest.importorskip("trc")
    recording = format_for(path).read(path)
    values = np.where(recording.visible, recording.values, NEW)
    out = tmp_path / "out.trc"
    format_for(path).write(out, recording.with_values(values), path)
    data = trc.TRCData()
    try:
        data.load(str(out))
    except Exception as error:
        pytest.skip(f"the package trc does not read the file: {type(error).__name__}")
    frames = [key for key in data if isinstance(key, int)]
    names = [name for name in data["Markers"] if name.strip()]
    wanted = [f"{name.strip()}.{axis}" for name in names for axis in "xyz"]
    read = np.array([np.ravel(data[frame][1])[: len(wanted)] for frame in frames])
    if np.isnan(read).all():
        pytest.skip("the package trc reads no number of rows with more cells than names")
    expected = recording.with_values(values).select(wanted).values[: len(frames)]
    assert np.allclose(read, expected, rtol=1e-12)
