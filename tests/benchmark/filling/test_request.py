import math
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.requests.refusals import NothingToFillError
from mocapbench.benchmark.filling.requests.request import NamedEntries, select
from mocapbench.datasets import Recording


def test_without_names_the_gaps_are_what_is_hidden(waves, hidden):
    mask = hidden((20, 30, [0]), (90, 95, [1, 2]))
    np.testing.assert_array_equal(select(waves().hide(mask), NamedEntries()).target, mask)


def test_named_frames_are_filled_though_they_are_visible_and_other_gaps_are_not(waves, hidden):
    recording = waves().hide(hidden((20, 30, [0])))
    request = select(recording, NamedEntries(frames=(50, 60), channels=("hip.*",)))
    np.testing.assert_array_equal(request.target, hidden((50, 60, [0, 1])))
    assert not request.given.visible[50:60, :2].any()
    assert not request.given.visible[20:30, 0].any()
    assert request.replaced == 20
    assert select(recording, NamedEntries(frames=(25, 35), channels=("hip.rx",))).replaced == 5
    assert select(recording, NamedEntries()).replaced == 0


def test_a_pattern_matches_whole_names_of_joints_or_channels(waves, hidden):
    recording = waves().hide(hidden((20, 30, [0, 2])))
    for pattern in ("knee.rx", "knee", "k*", "[!h]*", "?nee"):
        assert select(recording, NamedEntries(channels=(pattern,))).gaps == (Gap(20, 30, (2,)),)
    with pytest.raises(UsageError, match=r"--channels: .* got 'kne': did you mean knee"):
        select(recording, NamedEntries(channels=("hip", "kne")))


@pytest.fixture
def starred(waves):
    """Return a function from a mask to waves whose first three channels are of a marker ``*12``."""

    def make(mask):
        names = ("*12.x", "*12.y", "*12.z", "root.ty")
        return replace(waves().hide(mask), channels=names)

    return make


def test_ends_stay_open_and_are_counted_apart_from_gaps(waves, hidden):
    recording = waves().hide(hidden((0, 30, [0]), (50, 60, [0, 1]), (180, 200, [1])))
    request = select(recording, NamedEntries())
    assert request.gaps == (Gap(50, 60, (0, 1)),)
    assert request.open_ends == (Gap(0, 30, (0,)), Gap(180, 200, (1,)))
    assert not request.blank_ends
    assert select(recording, NamedEntries(channels=("hip.ry",))).open_ends == (Gap(180, 200, (1,)),)


def test_ends_are_filled_if_the_user_says_so(waves, hidden):
    mask = hidden((0, 30, [0]), (50, 60, [0, 1]), (180, 200, [1]))
    request = select(waves().hide(mask), NamedEntries(fill_ends=True))
    np.testing.assert_array_equal(request.target, mask)
    assert not request.open_ends


@pytest.mark.parametrize("fill_ends", [False, True])
def test_where_nobody_is_there_no_end_is_filled(waves, hidden, fill_ends):
    mask = hidden((0, 30, [0, 1, 2, 3]), (30, 35, [0]), (50, 60, [0, 1, 2, 3]), (190, 200, [1]))
    request = select(waves().hide(mask), NamedEntries(fill_ends=fill_ends))
    ends = (Gap(30, 35, (0,)), Gap(190, 200, (1,)))
    assert request.gaps == tuple(sorted((*ends * fill_ends, Gap(50, 60, (0, 1, 2, 3)))))
    assert request.open_ends == ends * (not fill_ends)
    assert request.blank_ends == (Gap(0, 30, (0, 1, 2, 3)),)


def test_strays_do_not_show_that_somebody_is_there(starred, hidden):
    mask = hidden((0, 30, [3]), (50, 60, [3]))
    assert select(starred(mask), NamedEntries()).blank_ends == (Gap(0, 30, (3,)),)
    named = select(starred(mask), NamedEntries(channels=("*",), fill_ends=True))
    np.testing.assert_array_equal(named.target, mask)


def test_a_channel_that_is_visible_nowhere_is_filled_where_somebody_is_there(waves, hidden):
    recording = waves().hide(hidden((0, 30, [0, 1, 2, 3]), (0, 200, [1])))
    request = select(recording, NamedEntries(), train=[waves(name="other")])
    assert request.gaps == (Gap(30, 200, (1,)),)


@pytest.mark.parametrize("frames", [(0, 40), (0, 30), (10, 20)])
def test_named_frames_are_filled_wherever_they_are(waves, hidden, frames):
    recording = waves().hide(hidden((0, 30, [0, 1, 2, 3]), (30, 40, [0])))
    request = select(recording, NamedEntries(frames))
    np.testing.assert_array_equal(request.target, hidden((*frames, [0, 1, 2, 3])))
    assert not request.open_ends
    assert not request.blank_ends


@pytest.mark.parametrize("lost", [[], [3]])
def test_where_only_ends_are_hidden_the_option_is_said(waves, hidden, lost):
    recording = waves().hide(hidden((0, 20, [0, 1, 2, 3]), (0, 30, [0, 1]), (0, 200, lost)))
    said = r"20 hidden entries before .* after the last [(]hip.rx and hip.ry[)]; --ends fill fills"
    with pytest.raises(NothingToFillError, match=said):
        select(recording, NamedEntries())
    blank = waves().hide(hidden((0, 20, [0, 1, 2, 3]), (0, 200, lost)))
    for fill_ends in (False, True):
        with pytest.raises(NothingToFillError, match=r"20 frames .* is visible; .*--frames"):
            select(blank, NamedEntries(fill_ends=fill_ends))


@pytest.mark.parametrize("frames", [None, (20, 30)])
def test_unlabelled_markers_stay_as_they_are_unless_they_are_named(starred, hidden, frames):
    recording = starred(hidden((5, 200, [0, 1, 2]), (20, 30, [3])))
    request = select(recording, NamedEntries(frames))
    assert request.gaps == (Gap(20, 30, (3,)),)
    assert request.unlabelled == ("*12.x", "*12.y", "*12.z")
    for pattern in ("*", "[*]12"):
        named = select(recording, NamedEntries(frames, channels=(pattern,), fill_ends=True))
        assert named.target[:, :3].any()
        assert not named.unlabelled


def test_where_only_unlabelled_markers_have_gaps_that_is_said(starred, hidden):
    recording = starred(hidden((5, 200, [0, 1, 2])))
    with pytest.raises(UsageError, match=r"hidden entries of 1 unlabelled marker only \(\*12\)"):
        select(recording, NamedEntries())


@pytest.mark.parametrize("frames", [None, (20, 30)])
def test_results_of_a_model_stay_as_they_are_unless_they_are_named(waves, hidden, frames):
    names = ("LFEO.x", "LFEO.y", "LFEO.z")
    recording = waves().hide(hidden((5, 190, [0, 1, 2]), (20, 30, [3])))
    recording = replace(recording, channels=(*names, "root.ty"))
    request = select(recording, NamedEntries(frames), results=names)
    assert request.gaps == (Gap(20, 30, (3,)),)
    assert request.outputs == request.results == names
    named = select(recording, NamedEntries(frames, channels=("*",)), results=names)
    assert named.target[:, :3].any()
    assert not named.outputs


def test_where_only_results_of_a_model_have_gaps_that_is_said(waves, hidden):
    names = ("LFEO.x", "LFEO.y", "LFEO.z", "root.ty")
    recording = replace(waves().hide(hidden((5, 90, [0, 1, 2]))), channels=names)
    with pytest.raises(UsageError, match=r"entries of 1 result of a model only \(LFEO\); --chan"):
        select(recording, NamedEntries(), results=names[:3])


@pytest.mark.parametrize(
    "entries", [NamedEntries(), NamedEntries(channels=("hip.*",)), NamedEntries((20, 30))]
)
def test_channels_that_nothing_can_tell_stay_as_they_are(waves, hidden, entries):
    mask = hidden((0, 200, [1]), (20, 30, [0]))
    request = select(waves().hide(mask), entries)
    assert request.unknown == ("hip.ry",)
    assert not request.target[:, 1].any()
    known = select(waves().hide(mask), entries, train=[waves(name="other")])
    assert not known.unknown
    assert known.target[:, 1].any()


def test_a_channel_that_is_visible_in_the_frames_to_fill_only_keeps_them(waves, hidden):
    recording = waves().hide(hidden((0, 50, [1]), (60, 200, [1])))
    request = select(recording, NamedEntries((50, 60)))
    assert request.unknown == ("hip.ry",)
    np.testing.assert_array_equal(request.given.values[:, 1], recording.values[:, 1])


def test_longer_gaps_stay_open(waves, hidden):
    recording = waves().hide(hidden((20, 30, [0]), (90, 140, [1])))
    request = select(recording, NamedEntries(max_gap=0.5))  # 25 frames
    assert request.gaps == (Gap(20, 30, (0,)),)
    assert request.left_open == (Gap(90, 140, (1,)),)


def test_angles_beside_a_named_gap_are_unwrapped_across_it():
    angles = [[170.0], [178.0], [-174.0], [-166.0]]
    turning = Recording("turn", np.arange(4) / 10, angles, ("hip.rx",), ("deg",))
    given = select(turning, NamedEntries(frames=(1, 2))).given
    np.testing.assert_allclose(given.values.ravel(), [170.0, np.nan, 186.0, 194.0])


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        (NamedEntries(), "expected a gap, got all entries visible"),
        (
            NamedEntries(frames=(0, 200)),
            "expected visible entries to fill the others from, got none",
        ),
        (NamedEntries(frames=(150, 201)), "expected --frames within 0:200"),
        (NamedEntries(frames=(60, 60)), "the first before the last, got 60:60"),
        (NamedEntries(channels=("(",)), r"got '\(': there are hip, knee and root. In a pattern"),
        (NamedEntries(frames=(50, 100), max_gap=0.1), "raise --max-gap"),
        (NamedEntries(frames=(50, 51), max_gap=0.0), "expected a gap of 0 s or less, got 1 of"),
        (NamedEntries(frames=(50, 51), max_gap=math.nan), "expected a gap of nan s or less"),
    ],
)
def test_what_cannot_be_filled_is_refused(waves, entries, message):
    with pytest.raises(UsageError, match=message):
        select(waves(), entries)


@pytest.mark.parametrize(("frames", "seconds"), [((0, 2), 3), ((2, 4), 9.33), ((6, 8), 96)])
def test_a_gap_lasts_as_long_as_its_frames_at_the_mean_distance_of_those_within_and_beside(
    frames, seconds
):
    times = 2.0 ** np.arange(8) - 1.0
    recording = Recording("slowing", times, np.ones((8, 1)), ("a",), ("",))
    with pytest.raises(UsageError, match=rf"got 1 of {seconds} s or more"):
        select(recording, NamedEntries(frames=frames, max_gap=seconds - 0.1))
    assert select(recording, NamedEntries(frames=frames, max_gap=seconds + 0.1)).gaps
