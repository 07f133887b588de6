"""C3D files of Intel, DEC and MIPS computers, of integers and floating-point numbers, are one."""

import tempfile
import warnings
from itertools import product
from pathlib import Path

import c3d
import ezc3d
import numpy as np
import pytest
from c3d_files import PROCESSORS, floats, write_bytes
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.datasets import C3DFormat, FormatWarning
from mocapbench.datasets.formats.markers import c3d_numbers

C3D = C3DFormat()
SCALE = 0.125
"""Of integers: a multiple of it is exact in any format."""
KINDS = list(product(PROCESSORS, [-1.0, SCALE]))


@st.composite
def positions(draw):
    """Positions (N, points, 3), multiples of the scale; some points are hidden."""
    shape = draw(st.tuples(st.integers(1, 9), st.integers(1, 6)))
    whole = draw(arrays(np.int16, (*shape, 3), elements=st.integers(-32767, 32767)))
    hidden = draw(arrays(np.bool_, shape)) | (whole == 0).all(axis=2)
    return np.where(hidden[..., None], np.nan, whole * SCALE)


def read_by_c3d(path):
    """Return positions (N, points, 3) and residuals (N, points) as the package c3d reads them."""
    with path.open("rb") as stream, warnings.catch_warnings(action="ignore"):
        points = np.array([one for _, one, _ in c3d.Reader(stream).read_frames()])
    return points[..., :3], points[..., 3]


def read_by_ezc3d(path):
    data = ezc3d.c3d(str(path))["data"]
    residuals = data["meta_points"]["residuals"][0].T
    return data["points"][:3].transpose(2, 1, 0), residuals


def readers(computer):
    """Return the other libraries that read files of a computer: ezc3d reads no MIPS."""
    return [read_by_c3d] if computer == "MIPS" else [read_by_c3d, read_by_ezc3d]


@pytest.mark.slow
@settings(max_examples=40)
@given(values=positions(), fills=st.integers(-32767, 32767), first=st.integers(1, 900))
def test_a_recording_reads_and_fills_alike_whatever_computer_wrote_it(values, fills, first):
    with tempfile.TemporaryDirectory() as folder:
        for computer, scale in KINDS:
            path = write_bytes(Path(folder, "given.c3d"), values, computer, scale, first=first)
            recording, out = C3D.read(path), Path(folder, "out.c3d")
            assert np.array_equal(recording.values.reshape(values.shape), values, equal_nan=True)
            filled = np.where(recording.visible, recording.values, fills * SCALE + SCALE)
            filled = np.minimum(filled, 32767 * SCALE)
            C3D.write(out, recording.with_values(filled), like=path)
            for read in readers(computer):
                found, residuals = read(out)
                assert np.array_equal(found, filled.reshape(values.shape)), (computer, scale, read)
                assert (residuals[np.isnan(values).any(axis=2)] == 0).all()
            out.unlink()


@pytest.mark.parametrize(("computer", "scale"), KINDS)
def test_no_byte_of_a_visible_point_changes(computer, scale, tmp_path):
    rng = np.random.default_rng(0)
    values = rng.uniform(-900, 900, (30, 4, 3))
    values[10:20, 2] = np.nan
    path = write_bytes(tmp_path / "given.c3d", values, computer, scale)
    recording = C3D.read(path)
    filled = np.where(recording.visible, recording.values, 1 / 3)
    C3D.write(tmp_path / "out.c3d", recording.with_values(filled), like=path)
    before, after = (np.frombuffer(p.read_bytes(), np.uint8) for p in (path, tmp_path / "out.c3d"))
    size = 2 if scale > 0 else 4
    start = len(before) - -(-30 * (16 + 6) * size // 512) * 512
    frames = np.arange(30 * 22 * size).reshape(30, 22, size)[10:20, 8:12]
    elsewhere = np.delete(np.arange(len(before)), start + frames.ravel())
    assert np.array_equal(before[elsewhere], after[elsewhere])
    again = C3D.read(tmp_path / "out.c3d").values[10:20, 6:9]
    assert np.allclose(again, 1 / 3, atol=scale / 2 if scale > 0 else 1e-8)


@given(st.floats(2.0**-126, 2.0**125, width=32), st.booleans())
def test_dec_numbers_are_ieee_numbers_times_four_with_words_swapped(size, negative):
    dec, value = c3d_numbers.PROCESSORS[85], np.array([-size if negative else size])
    stored = dec.encode(value)
    assert stored.astype("<u4").tobytes() == floats("DEC", value)
    assert dec.decode(stored) == value


@given(st.floats(-(2.0**125), 2.0**125))
def test_what_is_written_for_dec_is_what_single_precision_has(value):
    dec = c3d_numbers.PROCESSORS[85]
    (read,) = dec.decode(dec.encode(np.array([value])))
    assert read == (np.float32(value) if abs(np.float32(value)) >= 2.0**-128 else 0.0)


@pytest.mark.parametrize("bits", [0, 0x8000, 0x007F, 0x1234_0000])
def test_a_dec_number_with_the_exponent_0_is_0(bits):
    assert c3d_numbers.PROCESSORS[85].decode(np.array([bits], "<u4")) == 0.0


def test_a_nan_of_ieee_in_a_dec_file_is_no_number(tmp_path):
    values = np.full((3, 2, 3), 5.0)
    path = write_bytes(tmp_path / "given.c3d", values, "DEC")
    data = bytearray(path.read_bytes())
    at = data.index(floats("DEC", [5.0] * 3))
    data[at : at + 4] = b"\xff\x7f\xff\xff"
    path.write_bytes(data)
    assert C3D.read(path).visible[0].tolist() == [False] * 3 + [True] * 3


@pytest.mark.parametrize(
    ("computer", "scale", "limit"),
    [("Intel", 0.1, 3276.8), ("DEC", -1.0, 8.50706e37), ("MIPS", -1.0, 3.40282e38)],
)
def test_the_nearest_that_can_be_stored_is_written(computer, scale, limit, tmp_path):
    values = np.ones((5, 1, 3))
    values[2] = np.nan
    path = write_bytes(tmp_path / "given.c3d", values, computer, scale)
    recording = C3D.read(path)
    filled = recording.with_values(np.where(recording.visible, 1.0, -1e39))
    with pytest.warns(FormatWarning, match=r"got 3 beyond, up to -1e\+39, which are written"):
        C3D.write(tmp_path / "out.c3d", filled, like=path)
    np.testing.assert_allclose(C3D.read(tmp_path / "out.c3d").values[2], -limit, rtol=1e-5)
