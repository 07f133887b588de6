import pytest

from mocapbench.baselines.common.markers import markers_of


@pytest.mark.parametrize("separator", [".", "_", ":", " ", "-"])
def test_a_marker_is_three_channels_of_one_name(separator):
    channels = [f"LKNE{separator}{axis}" for axis in "XZY"]
    found = markers_of(["time of day", *channels, "RKNE.x"], ["s", "mm", "mm", "mm", "mm"])
    assert found == {"LKNE": (1, 3, 2)}


def test_angles_and_the_place_of_a_root_are_no_markers():
    channels = ["hip.rx", "hip.ry", "hip.rz", "root.tx", "root.ty", "root.tz"]
    assert markers_of(channels, ["deg"] * 3 + [""] * 3) == {}
    for unit in ("deg", "rad"):
        assert markers_of(["knee.x", "knee.y", "knee.z"], [unit] * 3) == {}
