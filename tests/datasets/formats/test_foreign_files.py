"""Files that this project did not make are filled, and other readers find what was filled.

The recordings are samples that packages on the index ship; other files are written by other
packages from these.
"""

import shutil
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from mocapbench.datasets import BVHFormat, C3DFormat, CSVFormat, TRCFormat, frame_rate

VICON = "vicon_CMJ_kinem_kinet_emg.c3d"


@pytest.fixture(scope="module")
def samples():
    """The folder of samples of the package biomdp: a jump by Vicon, angles by iSen."""
    found = find_spec("biomdp")
    if found is None:
        pytest.skip("the package biomdp is not installed")
    return Path(found.origin).parent / "tests" / "datasets"


@pytest.fixture(scope="module")
def jump(samples, tmp_path_factory):
    """The jump: the file, the recording read from it, one without gaps, and the file of that."""
    given = samples / VICON
    recording = C3DFormat().read(given)
    values = np.where(recording.visible, recording.values, 123.25)
    out = tmp_path_factory.mktemp("jump") / "filled.c3d"
    C3DFormat().write(out, recording.with_values(values), like=given)
    return given, recording, values, out


def test_a_jump_recorded_by_vicon(jump):
    _, recording, _, _ = jump
    results = C3DFormat().results(jump[0], recording.channels)
    markers = recording.select([name for name in recording.channels if name not in results])
    assert markers.values.shape == (1600, 72)
    assert set(markers.units) == {"mm"}
    assert frame_rate(recording) == pytest.approx(200.0)
    assert {"LASI.x", "*18.z", "RKJC.y"} < set(recording.channels)
    assert {name for name in recording.channels if name.startswith("USERMO")} <= {*results}
    assert 0.12 < (~markers.visible).mean() < 0.13


def test_another_reader_finds_the_filled_jump(jump):
    c3d = pytest.importorskip("c3d")
    given, recording, values, out = jump
    readers = []
    for path in (given, out):
        with path.open("rb") as file:
            frames = list(c3d.Reader(file).read_frames())
        readers.append((np.array([f[1] for f in frames]), np.array([f[2] for f in frames])))
    (before, analog), (after, analog_after) = readers
    assert np.array_equal(analog, analog_after, equal_nan=True)
    names = [name.partition(".")[0] for name in recording.channels[::3]]
    shown = after[:, : len(names), :3].reshape(1600, -1)
    assert np.array_equal(shown, values.astype(np.float32))
    seen = recording.visible[:, ::3]
    assert np.array_equal(after[:, : len(names)][seen], before[:, : len(names)][seen])
    assert (after[:, : len(names), 3][~seen] == 0).all()
    assert np.array_equal(after[:, len(names) :], before[:, len(names) :], equal_nan=True)


def test_a_trc_file_of_the_jump_by_another_writer(jump, tmp_path):
    trc = pytest.importorskip("trc")
    given, recording, _, _ = jump
    foreign = trc.TRCData()
    shutil.copy(given, tmp_path / "jump.c3d")
    foreign.import_from(str(tmp_path / "jump.c3d"), filter_output=["USERMOS"])
    foreign.save(str(tmp_path / "jump.trc"))
    markers = TRCFormat().read(tmp_path / "jump.trc", rate=200.0)
    names = [name for name in recording.channels if name in markers.channels]
    assert len(names) == 96
    one, two = recording.select(names), markers.select(names)
    assert np.array_equal(one.visible, two.visible)
    assert np.allclose(one.values, two.values, atol=1e-5, equal_nan=True)
    filled = markers.with_values(np.where(markers.visible, markers.values, 123.25))
    TRCFormat().write(tmp_path / "filled.trc", filled, like=tmp_path / "jump.trc")
    again = trc.TRCData()
    again.load(str(tmp_path / "filled.trc"))
    read = np.array([np.ravel(again[k + 1][1]) for k in range(1600)])
    assert np.array_equal(read, filled.values)


def test_a_bvh_file_by_another_writer(tmp_path):
    pybvh = pytest.importorskip("pybvh")
    bvhnode = pytest.importorskip("pybvh.bvhnode")
    rng = np.random.default_rng(0)
    root = bvhnode.BvhRoot("Hips", [0.0, 0.0, 0.0], list("XYZ"), list("ZXY"), [], None)
    knee = bvhnode.BvhJoint("Knee", [0.0, -40.0, 0.0], list("XYZ"), [], root)
    toe = bvhnode.BvhEndSite("Toe", [0.0, -40.0, 0.0], knee)
    root.children, knee.children = [knee], [toe]
    turns = np.cumsum(rng.uniform(-2.0, 2.0, (50, 2, 3)), axis=0)
    path = rng.uniform(-90, 90, (50, 3))
    foreign = pybvh.Bvh([root, knee, toe], path, (turns + np.pi) % (2 * np.pi) - np.pi, 1 / 30)
    pybvh.write_bvh_file(foreign, tmp_path / "given.bvh")
    recording = BVHFormat().read(tmp_path / "given.bvh")
    assert recording.channels[3:] == (
        "Hips.rz",
        "Hips.rx",
        "Hips.ry",
        "Knee.rx",
        "Knee.ry",
        "Knee.rz",
    )
    assert np.abs(np.diff(recording.values[:, 3:], axis=0)).max() <= 180.0
    assert frame_rate(recording) == pytest.approx(30.0)
    replaced = rng.random(recording.values.shape) < 0.2
    filled = recording.with_values(np.where(replaced, 200.5, recording.values))
    BVHFormat().write(tmp_path / "out.bvh", filled, tmp_path / "given.bvh", replaced)
    one = pybvh.read_bvh_file(tmp_path / "given.bvh", world_up="+y")
    two = pybvh.read_bvh_file(tmp_path / "out.bvh", world_up="+y")
    before, after = (
        np.column_stack([b.root_pos, np.degrees(b.joint_angles).reshape(50, -1)])
        for b in (one, two)
    )
    assert np.array_equal(after[~replaced], before[~replaced])
    assert np.allclose(after[:, :3][replaced[:, :3]], 200.5)
    assert np.allclose(after[:, 3:][replaced[:, 3:]], 200.5 - 360.0)


def test_angles_exported_by_isen(samples, tmp_path):
    given = tmp_path / "angles.csv"
    lines = (samples / "iSen_angles.csv").read_text(encoding="utf-8").splitlines()
    given.write_text("\n".join(lines[:200]), encoding="utf-8")
    angles = CSVFormat().read(given)
    assert angles.values.shape == (199, 67)
    assert frame_rate(angles) == pytest.approx(100.0, rel=1e-3)
    assert {"Rotación pelvis::Y", "Rotación pelvis::Y-3"} < {*angles.channels}
    filled = angles.with_values(np.where(angles.visible, angles.values, 1.5))
    CSVFormat().write(tmp_path / "out.csv", filled, like=given)
    before, after = (
        [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()]
        for path in (given, tmp_path / "out.csv")
    )
    assert all(
        two == one or (not one and two == "1.5")
        for row, other in zip(before, after, strict=True)
        for one, two in zip(row, other, strict=True)
    )


def test_sensors_of_isen_that_have_other_times_are_left_alone(samples, tmp_path):
    given, out = tmp_path / "sensors.csv", tmp_path / "out.csv"
    lines = (samples / "iSen_sensors.csv").read_text(encoding="utf-8").splitlines()
    given.write_text("\n".join(lines[:200]), encoding="utf-8")
    with pytest.warns(UserWarning, match="times are not those of the first column: BOLT.* 64 more"):
        sensors = CSVFormat().read(given)
    assert sensors.values.shape == (199, 30)
    with pytest.warns(UserWarning, match="times are not those"):
        CSVFormat().write(out, sensors, like=given)
    assert out.read_bytes() == given.read_bytes()


def test_a_table_of_nexus_has_the_positions_of_the_c3d_file(samples, jump):
    """The table has blocks of devices, joints, results of models and trajectories."""
    table = CSVFormat().read((samples / VICON).with_suffix(".csv"))
    _, positions, _, _ = jump
    seen = table.visible.all(axis=0)
    shown = [name for name, whole in zip(table.channels, seen, strict=True) if whole]
    assert len(shown) == 54  # the table lacks markers that were reconstructed later
    assert {*table.units} == {"mm"}
    theirs = positions.select([name.removeprefix("S03:") for name in shown])
    np.testing.assert_allclose(table.times, theirs.times, atol=1e-9)
    np.testing.assert_allclose(table.select(shown).values, theirs.values, atol=1e-4)
