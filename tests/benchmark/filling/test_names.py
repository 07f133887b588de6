import pytest

from mocapbench.benchmark.filling.requests.names import name_markers
from mocapbench.datasets.formats.strays import is_unlabelled


def test_one_name_stands_for_the_channels_of_a_marker():
    channels = ["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"]
    assert name_markers(channels) == ("LKNE", "RKNE.x", "hip.rx")


@pytest.mark.parametrize(
    ("channel", "unlabelled"),
    [
        ("*12.x", True),
        ("unlabelled.x", True),
        ("unlabelled-2.z", True),
        ("unlabelled", False),
        ("u_1", False),
        ("Ann:*3.y", True),
        ("*Unnamed_58.x", True),
        ("Unnamed_58.x", True),
        ("New 0000.x", True),
        ("New 0001-2.y", True),
        ("Unlabeled 1200.x", True),
        ("UNLABELED1200.x", True),
        ("Unlabeled_7.Z", True),
        ("U_3.x", True),
        ("uname*3.x", True),
        ("unidentified 4_X", True),
        ("?7.x", True),
        ("Unlabeled (12).x", True),
        ("unidentified marker 3.x", True),
        ("Unknown.x", True),
        ("Newton.x", False),
        ("New.x", False),
        ("LKNE New 1.x", False),
        ("U.x", False),
        ("UN_3.x", False),
        ("U_LEG.x", False),
        ("Unlabeled knee.x", False),
        ("12.x", False),
        ("LKNE.x", False),
        ("*LKNE.x", False),
        ("LKNE*1.x", False),
    ],
)
def test_markers_with_a_star_and_a_number_or_without_a_name_are_unlabelled(channel, unlabelled):
    assert is_unlabelled(channel) == unlabelled
