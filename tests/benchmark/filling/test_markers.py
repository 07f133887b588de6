import pytest

from mocapbench.benchmark.filling.markers import is_unlabelled, markers, markers_of


@pytest.mark.parametrize("separator", [".", "_", ":", " "])
def test_a_marker_is_three_channels_of_one_name(separator):
    channels = [f"LKNE{separator}{axis}" for axis in "XYZ"]
    assert markers(["time of day", *channels, "RKNE.x"]) == {"LKNE": [1, 2, 3]}
    assert markers_of([*channels, "RKNE.x"]) == ("LKNE", "RKNE.x")


def test_angles_and_the_place_of_a_root_are_no_markers():
    assert markers(["hip.rx", "hip.ry", "hip.rz", "root.tx", "root.ty", "root.tz"]) == {}


@pytest.mark.parametrize(
    ("channel", "unlabelled"),
    [
        ("*12.x", True),
        ("unlabelled.x", True),
        ("unlabelled-2.z", True),
        ("LKNE.x", False),
        ("*LKNE.x", False),
        ("LKNE*1.x", False),
    ],
)
def test_markers_with_a_star_and_a_number_or_without_a_name_are_unlabelled(channel, unlabelled):
    assert is_unlabelled(channel) == unlabelled
