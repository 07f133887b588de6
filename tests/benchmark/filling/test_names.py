import pytest

from mocapbench.benchmark.filling.requests.names import is_unlabelled, marker_names


def test_one_name_stands_for_the_channels_of_a_marker():
    channels = ["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"]
    assert marker_names(channels) == ("LKNE", "RKNE.x", "hip.rx")


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
