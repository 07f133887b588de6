import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.choosing.kinds import Kind, tell_kinds
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.gaps import mask_gaps
from mocapbench.datasets import Recording

CHANNELS = ("A.x", "A.y", "A.z", "B.x", "B.y", "B.z", "hip.rx", "hip.ry")
UNITS = ("mm",) * 6 + ("deg",) * 2


def hide(*gaps, rate=100.0, n_frames=400, also=()):
    """Return the problem of filling gaps (start, length, channels); others are hidden ``also``."""
    target, hidden = (np.zeros((n_frames, len(CHANNELS)), dtype=bool) for _ in range(2))
    for mask, blocks in ((target, gaps), (hidden, (*gaps, *also))):
        for start, length, channels in blocks:
            mask[start : start + length, channels] = True
    values = np.arange(float(hidden.size)).reshape(hidden.shape)
    whole = Recording("r", np.arange(n_frames) / rate, values, CHANNELS, UNITS)
    return GapProblem(whole.hide(hidden), target)


def kinds_of(problem):
    return {kind for kinds in tell_kinds(problem).values() for kind in kinds}


GAPS = st.lists(
    st.tuples(
        st.integers(0, 390),
        st.integers(1, 150),
        st.lists(st.integers(0, len(CHANNELS) - 1), min_size=1, unique=True),
    ),
    min_size=1,
    max_size=5,
)


@settings(deadline=None)
@given(GAPS)
def test_every_wanted_entry_is_of_exactly_one_kind_and_its_unit_is_that_of_its_channel(gaps):
    problem = hide(*gaps)
    count = np.zeros(problem.target.shape, dtype=int)
    for gap, kinds in tell_kinds(problem).items():
        for kind, channels in kinds.items():
            assert {UNITS[channel] for channel in channels} == {kind.unit}
            count[gap.start : gap.stop, list(channels)] += 1
        assert sorted(sum(kinds.values(), ())) == [*gap.channels]
    np.testing.assert_array_equal(count, problem.target)
    assert (mask_gaps(tell_kinds(problem), problem.target.shape) == problem.target).all()


@pytest.mark.parametrize(
    ("channels", "also", "extent"),
    [
        ([0], (), "one marker or joint"),
        ([0, 1, 2], (), "one marker or joint"),
        ([6, 7], (), "one marker or joint"),
        ([2, 3], (), "several markers or joints"),
        ([0, 1, 2], ((90, 40, [5]),), "several markers or joints"),
        ([0, 1, 2], ((100, 2, [5]),), "one marker or joint"),
        (range(8), (), "whole frames"),
        ([*range(6)], ((90, 40, [6, 7]),), "whole frames"),
        ([*range(6)], ((90, 16, [6, 7]),), "whole frames"),
        ([*range(6)], ((90, 15, [6, 7]),), "several markers or joints"),
    ],
)
def test_the_extent_is_what_is_hidden_at_once_in_most_frames_to_be_filled_or_not(
    channels, also, extent
):
    assert {kind.extent for kind in kinds_of(hide((100, 10, channels), also=also))} == {extent}


@pytest.mark.parametrize("rate", [25.0, 100.0, 119.88])
@pytest.mark.parametrize(
    ("most", "beyond"), [(0.25, "up to 1 s"), (1.0, "longer")], ids=["a quarter", "a second"]
)
def test_the_length_is_in_seconds_whatever_the_rate(rate, most, beyond):
    frames = int(most * rate)
    within = hide((100, frames, [0]), rate=rate)
    assert {kind.length for kind in kinds_of(within)} == {f"up to {most:g} s"}
    assert {kind.length for kind in kinds_of(hide((100, frames + 1, [0]), rate=rate))} == {beyond}


def test_a_gap_in_angles_and_places_is_of_two_kinds():
    assert kinds_of(hide((100, 10, [0, 1, 2, 6]))) == {
        Kind("deg", "several markers or joints", "up to 0.25 s"),
        Kind("mm", "several markers or joints", "up to 0.25 s"),
    }


def test_a_kind_is_said_without_a_unit_that_there_is_not():
    assert str(Kind("mm", "whole frames", "longer")) == "whole frames, longer, mm"
    assert str(Kind("", "whole frames", "longer")) == "whole frames, longer"


def test_a_recording_of_one_frame_has_kinds():
    assert kinds_of(hide((0, 1, [0]), n_frames=1)) == {
        Kind("mm", "one marker or joint", "up to 0.25 s")
    }
