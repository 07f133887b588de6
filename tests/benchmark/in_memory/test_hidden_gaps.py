"""Gaps lie where the seed says, apart from each other, and hide what they are asked to hide."""

import re
from itertools import pairwise

import numpy as np
import pytest

from mocapbench import Gaps
from mocapbench.datasets import GaitLibrary, Recording

ARM = ("humerus", "radius", "wrist", "hand", "fingers", "thumb")


def owners(recording, gap):
    return {recording.channels[channel].split(".")[0] for channel in gap.channels}


@pytest.mark.parametrize(
    ("what", "sizes"), [("channel", {1}), ("marker", {3}), ("limb", {12}), ("frames", {12})]
)
def test_a_gap_hides_what_it_is_asked_to(walk, what, sizes):
    recording = walk()
    gaps = Gaps(0.2, what, count=3).place(recording)
    assert {len(gap.channels) for gap in gaps} == sizes
    assert {len(gap) for gap in gaps} == {12}
    if what == "marker":
        assert all(len(owners(recording, gap)) == 1 for gap in gaps)


def test_a_limb_is_an_arm_or_a_leg():
    recording = GaitLibrary().recording("01_01")
    gaps = Gaps(0.1, "limb", count=6).place(recording)
    assert {len({name[0] for name in owners(recording, gap)}) for gap in gaps} == {1}
    assert {frozenset(owners(recording, gap)) for gap in gaps} <= {
        frozenset(("lfemur", "ltibia", "lfoot", "ltoes")),
        frozenset(("rfemur", "rtibia", "rfoot", "rtoes")),
        *(frozenset(f"{side}{name}" for name in ARM) for side in "lr"),
    }


def test_without_names_a_limb_is_a_marker_with_those_nearest_to_it():
    places = np.array([0.0, 1.0, 2.0, 3.0, 100.0, 101.0, 102.0, 103.0])
    names = [f"{letter}.{axis}" for letter in "abcdefgh" for axis in "xyz"]
    values = np.repeat(places, 3) + np.zeros((60, 1))
    recording = Recording("two", np.arange(60) / 10, values, names, ["m"] * 24)
    for seed in range(5):
        for gap in Gaps(0.5, "limb", 2, seed).place(recording):
            assert owners(recording, gap) in ({*"abcd"}, {*"efgh"})


def test_the_seed_alone_decides_where_gaps_are(walk):
    one, same, other = (
        Gaps(0.2, seed=seed).place(walk(seed=n)) for n, seed in enumerate((1, 1, 2))
    )
    assert one == same
    assert one != other


def test_gaps_share_no_frames_while_there_is_room(walk):
    gaps = Gaps(0.25, "marker", count=8).place(walk())
    assert all(gap.stop < after.start for gap, after in pairwise(gaps))
    crowded = Gaps(1.5, "marker", count=4).place(walk())
    assert len({gap.channels for gap in crowded}) == 4


def test_what_is_hidden_already_is_not_hidden_again(gappy):
    for gap in Gaps(0.5, count=6).place(gappy):
        assert gappy.visible[gap.start - 1 : gap.stop + 1, list(gap.channels)].all()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((0,), "expected seconds= above 0, got 0"),
        ((np.nan,), "expected seconds= above 0, got nan"),
        ((1, "arm"), "expected what= as one of channel, marker, limb, frames, got 'arm'"),
        ((1, "limb", 0), "expected count= of 1 or more, got 0"),
        (("x",), "expected seconds= above 0, got 'x'"),
        (([0.1, 0.2],), "expected seconds= above 0, got [0.1, 0.2]"),
        ((1, "limb", 1.5), "expected count= of 1 or more, got 1.5"),
    ],
)
def test_what_is_no_gap_is_refused(arguments, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        Gaps(*arguments)


@pytest.mark.parametrize(
    ("gaps", "said"),
    [
        (Gaps(5), "walk: expected 1 visible stretches of 5 s"),
        (Gaps(0.001), "walk: expected gaps of a frame or more"),
        (Gaps(0.5, "frames", 1000), r"; there is room for \d+ of 1000 gaps; hide fewer"),
    ],
)
def test_a_recording_without_room_is_refused(walk, gaps, said):
    with pytest.raises(ValueError, match=said):
        gaps.place(walk())


def test_a_recording_of_one_frame_has_no_rate(walk):
    one = walk().frames(np.array([0]))
    with pytest.raises(ValueError, match="expected two frames or more, which have a rate, got 1"):
        Gaps(0.5).place(one)


def test_of_too_few_markers_there_is_no_limb(walk):
    with pytest.raises(ValueError, match="4 markers, to hide a limb, got 1 markers"):
        Gaps(0.5, "limb").place(walk().select(["LKNE.x", "LKNE.y", "LKNE.z"]))
