"""Archives of arrays with the pose of every frame (.npz), as AMASS and SMPL have them."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.memory import check_fits
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["NPZFormat"]

_POSES = ("poses", "fullpose", "smpl_poses", "pose")
_TRANSLATIONS = ("trans", "transl", "translation", "smpl_trans")
_RATES = (
    "mocap_framerate",
    "mocap_frame_rate",
    "framerate",
    "frame_rate",
    "fps",
    "mocap_fps",
    "rate",
)
_PARTS: Mapping[str, tuple[int, ...]] = {
    "root_orient": (0,),
    "pose_body": (3,),
    "pose_jaw": (66,),
    "pose_eye": (69,),
    "pose_hand": (75, 66),
}
"""Arrays that repeat some columns of the poses, and with which column they may begin."""
_JOINTS = (
    *("pelvis", "left_hip", "right_hip", "spine1", "left_knee", "right_knee", "spine2"),
    *("left_ankle", "right_ankle", "spine3", "left_foot", "right_foot", "neck", "left_collar"),
    *("right_collar", "head", "left_shoulder", "right_shoulder", "left_elbow", "right_elbow"),
    *("left_wrist", "right_wrist"),
)
"""Which SMPL, SMPL-H and SMPL-X have in common."""
_UNITY = 1e-3
"""How far matrices and quaternions are from rotations, at most."""
_MEMORY = 4.0
"""Bytes that reading takes for each byte of an array."""


class NPZFormat(Format):
    """Archives of NumPy arrays (.npz) with poses and translations, of AMASS and SMPL.

    The channels are ``left_knee.rx`` and so on, parts of rotation vectors in radians, and
    ``trans.x``, ``trans.y`` and ``trans.z`` in metres. NaN is hidden. The rate is an array such as
    ``mocap_framerate`` or ``fps``. Only the entries that are filled are changed, in the array of
    all poses and in those that repeat a part of it, such as ``pose_body``; all other arrays stay.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".npz",)
    memory_per_byte: ClassVar[float] = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        with _open_archive(path) as archive:
            arrays = _read_arrays(path, archive)
            values = np.hstack([array.flat() for array in arrays])
            times = even_times(len(values), rate or _frame_rate(path.name, archive))
        channels = [name for array in arrays for name in array.channels()]
        units = [array.unit for array in arrays for _ in array.channels()]
        return recording_of(path.name, times, values, channels, units)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's arrays with the new entries."""
        with _open_archive(like) as archive, zipfile.ZipFile(path, "w") as out:
            changed = _change_arrays(like, archive, values, new)
            out.comment = archive.comment
            for member in archive.infolist():
                data = changed.get(member.filename) or _read_member(like, archive, member)
                out.writestr(member, data)


class _Array(NamedTuple):
    """An array of the archive, of one row a frame."""

    name: str
    unit: str
    head: bytes
    values: NDArray[Any]
    order: str

    def flat(self) -> FrameByChannel:
        """Return its values as (N, D)."""
        return self.values.reshape(len(self.values), -1).astype(np.float64)

    def channels(self) -> list[str]:
        """Return the names of the channels, by joints if they are rotations."""
        n_channels = self.values[:1].size
        if self.unit == "m":
            return [f"trans.{axis}" for axis in "xyz"]
        joints = [*_JOINTS, *(f"joint{k}" for k in range(len(_JOINTS), n_channels))]
        return [f"{joints[k // 3]}.r{'xyz'[k % 3]}" for k in range(n_channels)]

    def with_entries(self, values: FrameByChannel, new: Mask) -> bytes:
        """Return the bytes of the array with the new entries (N, D)."""
        entries = self.values.reshape(len(self.values), -1).copy()
        entries[new] = values[new]
        order = "F" if self.order == "F" else "C"
        return self.head + entries.reshape(self.values.shape).tobytes(order)  # type: ignore[arg-type]


@contextmanager
def _open_archive(path: Path) -> Iterator[zipfile.ZipFile]:
    """Open an archive, and turn what damage raises into a `FormatError`."""
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        KeyError,
        NotImplementedError,
        OverflowError,
        RuntimeError,
        SyntaxError,
        TypeError,
    ) as error:
        advice = "save it again with numpy.savez"
        got = str(error) or type(error).__name__
        raise FormatError(path.name, "an archive of NumPy arrays", got, advice) from error


def _read_arrays(path: Path, archive: zipfile.ZipFile) -> list[_Array]:
    """Return the poses and, if there are any, the translations."""
    poses = _read_first(path, archive, _POSES, "rad")
    if poses is None:
        there = ", ".join(_names(archive)[:6]) or "none"
        expected = "an array 'poses' with the rotation vectors of all joints in every frame"
        advice = "save the poses under that name, and translations as 'trans'"
        raise FormatError(path.name, expected, f"the arrays {there}", advice)
    translations = _read_first(path, archive, _TRANSLATIONS, "m")
    arrays = [poses, *([translations] if translations else [])]
    for array in arrays:
        shape = array.values.shape
        flat = shape[1] % 3 == 0 if len(shape) == 2 else shape[2:] == (3,)
        whole = flat if array is poses else shape[1:] == (3,)
        if not whole or shape[0] != len(poses.values):
            expected = f"a row of three numbers a joint for each of {len(poses.values)} frames"
            got = f"the shape {shape} of {array.name!r}"
            raise FormatError(path.name, expected, got, "save the arrays of one motion")
    _check_rotation_vectors(path.name, poses)
    return arrays


def _check_rotation_vectors(file: str, poses: _Array) -> None:
    """Refuse matrices and quaternions, which have three numbers a joint or a multiple by chance."""
    values = poses.flat()
    seen = values[np.isfinite(values).all(axis=1)]
    columns = values.shape[1]
    others = {}
    if len(seen) and columns % 9 == 0:
        matrices = seen.reshape(-1, 3, 3)
        others["rotation matrices"] = matrices @ matrices.transpose(0, 2, 1) - np.eye(3)
    if len(seen) and columns % 4 == 0:
        others["quaternions"] = np.linalg.norm(seen.reshape(-1, 4), axis=1) - 1.0
    for name, error in others.items():
        if np.abs(error).max() < _UNITY:
            expected, got = f"rotation vectors in {poses.name!r}", f"{columns} numbers of {name}"
            advice = "convert them, with Rotation of scipy for instance"
            raise FormatError(file, expected, got, advice)


def _read_first(
    path: Path, archive: zipfile.ZipFile, names: Sequence[str], unit: str
) -> _Array | None:
    """Return the first array of some names, if there is one."""
    found = next((name for name in names if name in _names(archive)), None)
    if found is None:
        return None
    array = _read_array(path, archive, found, unit)
    if array.values.dtype.kind != "f" or array.values.ndim < 2 or not array.values.size:
        expected = f"real numbers in {found!r}, one row a frame"
        got = f"{array.values.dtype} of shape {array.values.shape}"
        raise FormatError(path.name, expected, got, "save them as floating-point numbers")
    return array


def _read_array(path: Path, archive: zipfile.ZipFile, name: str, unit: str = "") -> _Array:
    """Return an array, whose header agrees with its size; objects of Python are not read."""
    data = _read_member(path, archive, archive.getinfo(f"{name}.npy"))
    stream = io.BytesIO(data)
    readers = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }
    version = np.lib.format.read_magic(stream)
    if version not in readers:
        raise ValueError(f"version {version} of the array {name!r}")
    shape, fortran, dtype = readers[version](stream)
    start = stream.tell()
    n_bytes = dtype.itemsize * int(np.prod([float(length) for length in shape]))
    if dtype.hasobject or n_bytes != len(data) - start:
        got = f"{len(data) - start} bytes" if not dtype.hasobject else "objects of Python"
        expected = f"{n_bytes} bytes of numbers in {name!r}, as its header says"
        raise FormatError(path.name, expected, got, "save it again with numpy.savez")
    values = np.frombuffer(data, dtype, offset=start).reshape(shape, order="F" if fortran else "C")
    return _Array(name, unit, data[:start], values, "F" if fortran else "C")


def _read_member(path: Path, archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """Return the bytes of a member, which a small file may unfold to more than fits in memory."""
    check_fits(path.name, member.file_size, _MEMORY * member.file_size)
    return archive.read(member)


def _frame_rate(file: str, archive: zipfile.ZipFile) -> float:
    """Return the frames per second that an array states."""
    for name in _RATES:
        if name in _names(archive):
            values = _read_array(Path(file), archive, name).values
            if values.dtype.kind in "iuf" and values.size == 1 and float(values.item()) > 0:
                return float(values.item())
    expected = f"a positive rate in an array {_RATES[0]!r}, {_RATES[1]!r} or 'fps'"
    advice = "name the rate in frames per second, such as --rate 100"
    raise FormatError(file, expected, "none", advice)


def _change_arrays(
    path: Path, archive: zipfile.ZipFile, values: FrameByChannel, new: Mask
) -> Mapping[str, bytes]:
    """Return the bytes of the members that have new entries, by their names."""
    arrays = _read_arrays(path, archive)
    poses = arrays[0].flat()
    changed, first = {}, 0
    for array in arrays:
        there = slice(first, first + array.flat().shape[1])
        changed[array.name] = array.with_entries(values[:, there], new[:, there])
        first = there.stop
    for name in _PARTS.keys() & {*_names(archive)}:
        part = _read_array(path, archive, name)
        for there in _find_part(poses, part):
            changed[name] = part.with_entries(values[:, there], new[:, there])
    return {f"{name}.npy": data for name, data in changed.items()}


def _find_part(poses: FrameByChannel, part: _Array) -> Iterator[slice]:
    """Yield the columns of the poses that an array repeats, if it does."""
    for start in _PARTS[part.name]:
        there = slice(start, start + part.values[:1].size)
        if np.array_equal(poses[:, there], part.flat(), equal_nan=True):
            yield there


def _names(archive: zipfile.ZipFile) -> list[str]:
    return [name.removesuffix(".npy") for name in archive.namelist() if name.endswith(".npy")]
