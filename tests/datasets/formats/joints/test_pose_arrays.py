"""Archives of poses: what is read, what is kept, and what is no such archive."""

import io
import zipfile

import numpy as np
import pytest
from format_files import poses, sample
from scipy.spatial.transform import Rotation

from mocapbench.datasets import FormatError, NPZFormat, frame_rate

NPZ = NPZFormat()


@pytest.fixture
def given(tmp_path):
    return sample("npz", tmp_path)


@pytest.fixture
def save(tmp_path):
    """Return a function that saves arrays as an archive, and returns its path."""

    def save(**arrays):
        np.savez(tmp_path / "motion.npz", **arrays)
        return tmp_path / "motion.npz"

    return save


def test_rotations_are_in_radians_and_translations_in_metres(given):
    walk = NPZ.read(given)
    assert walk.channels[:4] == ("pelvis.rx", "pelvis.ry", "pelvis.rz", "left_hip.rx")
    assert walk.channels[-6:] == (
        *("right_wrist.rx", "right_wrist.ry", "right_wrist.rz"),
        *("trans.x", "trans.y", "trans.z"),
    )
    assert walk.units == ("rad",) * 66 + ("m",) * 3
    assert frame_rate(walk) == pytest.approx(120.0)
    assert np.argwhere(~walk.visible).min(axis=0).tolist() == [20, 0]
    assert (~walk.visible).sum() == 30


@pytest.mark.parametrize(
    ("poses_", "trans", "rate"),
    [
        ("poses", "trans", "mocap_framerate"),
        ("poses", "trans", "mocap_frame_rate"),
        ("fullpose", "transl", "fps"),
        ("smpl_poses", "smpl_trans", "frame_rate"),
    ],
)
@pytest.mark.parametrize("dtype", ["float32", "float64", ">f8"])
def test_arrays_by_their_usual_names(save, poses_, trans, rate, dtype):
    values = poses().values.astype(dtype)
    shaped = values[:, :66].reshape(60, 22, 3) if rate == "fps" else values[:, :66]
    path = save(**{poses_: shaped, trans: values[:, 66:], rate: np.array([120])})
    read = NPZ.load(path, None)
    np.testing.assert_array_equal(read.values, values.astype(float))
    assert frame_rate(read) == pytest.approx(120.0)


def test_poses_alone_will_do(save):
    assert len(NPZ.read(save(poses=np.zeros((5, 156))), rate=30.0).channels) == 156


def test_only_what_is_filled_changes_also_where_it_is_repeated(given, tmp_path):
    walk, out = NPZ.read(given), tmp_path / "out.npz"
    filled = walk.with_values(np.where(walk.visible, walk.values, 0.125))
    NPZ.write(out, filled, given)
    with np.load(given) as one, np.load(out) as two:
        assert one.files == two.files
        for name in one.files:
            new = np.isnan(one[name]) if one[name].dtype.kind == "f" else np.zeros(1, dtype=bool)
            assert one[name].dtype == two[name].dtype
            expected = np.where(new, 0.125, one[name]) if new.any() else one[name]
            np.testing.assert_array_equal(two[name], expected)
        assert np.isnan(one["root_orient"]).any()
    with zipfile.ZipFile(given) as one, zipfile.ZipFile(out) as two:
        kept = [(m.filename, m.date_time, m.compress_type) for m in one.infolist()]
        assert [(m.filename, m.date_time, m.compress_type) for m in two.infolist()] == kept


def test_arrays_of_objects_that_nobody_needs_are_kept_unread(save, tmp_path):
    path = save(poses=np.zeros((5, 6)), fps=60.0, labels=np.array([{"a": 1}], dtype=object))
    walk = NPZ.read(path)
    new = np.eye(5, 6, dtype=bool)
    NPZ.write(tmp_path / "out.npz", walk.with_values(np.ones((5, 6))), path, new)
    with zipfile.ZipFile(path) as one, zipfile.ZipFile(tmp_path / "out.npz") as two:
        assert one.read("labels.npy") == two.read("labels.npy")
    with np.load(tmp_path / "out.npz") as after:
        np.testing.assert_array_equal(after["poses"], new)


def test_columns_one_after_another_stay_so(save, tmp_path):
    path = save(poses=np.asfortranarray(np.arange(30.0).reshape(5, 6)), fps=60.0)
    walk, out = NPZ.read(path), tmp_path / "out.npz"
    NPZ.write(out, walk, path, np.zeros((5, 6), dtype=bool))
    with zipfile.ZipFile(path) as one, zipfile.ZipFile(out) as two:
        assert one.read("poses.npy") == two.read("poses.npy")
    with np.load(out) as after:
        assert after["poses"].flags.f_contiguous


@pytest.mark.parametrize(
    ("arrays", "complaint"),
    [
        ({"joints": np.zeros((5, 6))}, r"an array 'poses' .*, got the arrays joints; save the"),
        ({"poses": np.zeros((5, 6))}, r"a positive rate in an array 'mocap_framerate', .* --rate"),
        ({"poses": np.zeros((5, 6)), "fps": 0.0}, "a positive rate in an array"),
        ({"poses": np.zeros((5, 6)), "fps": "fast"}, "a positive rate in an array"),
        ({"poses": np.zeros((5, 7)), "fps": 1.0}, r"three numbers a joint .* shape \(5, 7\) of 'p"),
        (
            {"poses": np.zeros((5, 6)), "trans": np.zeros((4, 3)), "fps": 1.0},
            r"5 frames, .*\(4, 3\)",
        ),
        (
            {"poses": np.zeros((5, 6)), "trans": np.zeros((5, 2)), "fps": 1.0},
            r"\(5, 2\) of 'trans'",
        ),
        ({"poses": np.zeros(6), "fps": 1.0}, r"one row a frame, got float64 of shape \(6,\); save"),
        ({"poses": np.zeros((5, 6), int), "fps": 1.0}, "real numbers in 'poses'"),
        ({"poses": np.array([{}, 1], dtype=object)}, "bytes of numbers in 'poses', .* objects of"),
        ({"poses": np.zeros((0, 6)), "fps": 1.0}, "one row a frame"),
    ],
)
def test_what_is_no_archive_of_poses_is_said_plainly(save, arrays, complaint):
    with pytest.raises(FormatError, match=complaint):
        NPZ.read(save(**arrays))


def test_a_header_that_claims_more_than_there_is_takes_no_memory(save):
    path = save(poses=np.zeros((5, 6)), fps=60.0)
    with zipfile.ZipFile(path) as archive:
        data = {name: archive.read(name) for name in archive.namelist()}
    claim = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (10**12, 6)}
    np.lib.format.write_array_header_1_0(claim, header)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("poses.npy", claim.getvalue() + b"0" * 48)
        archive.writestr("fps.npy", data["fps.npy"])
    with pytest.raises(FormatError, match="expected 48000000000000 bytes of numbers in 'poses'"):
        NPZ.read(path)


@pytest.mark.parametrize("keep", [0, 3, 100, 2000])
def test_an_archive_that_is_cut_short(given, keep):
    given.write_bytes(given.read_bytes()[:keep])
    with pytest.raises(FormatError, match=r"expected an archive of NumPy arrays, got .*; save it"):
        NPZ.read(given)


def matrices(n_frames, n_joints):
    vectors = np.random.default_rng(0).normal(size=(n_frames * n_joints, 3))
    return Rotation.from_rotvec(vectors)


OTHERS = {
    "matrices": (lambda r: r.as_matrix().reshape(8, 24, 3, 3), "row of three numbers"),
    "matrices, flat": (lambda r: r.as_matrix().reshape(8, 216), "216 numbers of rotation matrices"),
    "quaternions": (lambda r: r.as_quat().reshape(8, 24, 4), "row of three numbers"),
    "quaternions, flat": (lambda r: r.as_quat().reshape(8, 96), "96 numbers of quaternions"),
    "six numbers": (lambda r: r.as_matrix()[:, :2].reshape(8, 24, 6), "row of three numbers"),
    "two people": (lambda r: r.as_rotvec().reshape(2, 4, 72), "row of three numbers"),
}


@pytest.mark.parametrize("kind", OTHERS)
def test_rotations_that_are_no_vectors_are_refused(save, kind):
    change, complaint = OTHERS[kind]
    path = save(poses=change(matrices(8, 24)), fps=np.array(30))
    with pytest.raises(FormatError, match=complaint):
        NPZ.read(path)
