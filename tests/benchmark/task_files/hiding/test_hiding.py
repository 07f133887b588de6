import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.task_files.hiding.base import HidingError, HidingPlace
from mocapbench.benchmark.task_files.hiding.random_entries import RandomEntries
from mocapbench.benchmark.task_files.hiding.random_gaps import RandomGaps
from mocapbench.benchmark.task_files.hiding.same_gaps import SameGaps
from mocapbench.benchmark.task_files.hiding.spans import Spans
from mocapbench.benchmark.task_files.selection import Selection, Span
from mocapbench.datasets import Archive, Library, Recording

RATE, CHANNELS = 50.0, ("hip.x", "hip.y", "knee.x", "sole")


def recording(n_frames=80, gaps=(), name="walk", rate=RATE):
    values = np.random.default_rng(0).normal(size=(n_frames, len(CHANNELS)))
    for start, stop, column in gaps:
        values[start:stop, column] = np.nan
    return Recording(name, np.arange(n_frames) / rate, values, CHANNELS, [""] * len(CHANNELS))


class Shelf(Library):
    """Recordings by name."""

    def __init__(self, **recordings):
        super().__init__()
        self.recordings = recordings

    def where(self, key):
        return "here" if key in self.recordings else ""

    def recording(self, key):
        return self.recordings[key]


def place(fold=0, seed=0, **recordings):
    archive = Archive({"shelf": Shelf(**recordings)})
    return HidingPlace(fold, np.random.default_rng([seed, fold]), archive)


def runs_of(column):
    """Return (start, length) of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], column.astype(int), [0]])))
    return [(int(a), int(b - a)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


@given(start=st.integers(0, 79), length=st.integers(1, 80), fold=st.integers(0, 3))
def test_spans_hide_what_they_say_in_every_fold(start, length, fold):
    stop = min(start + length, 80)
    hidden = Spans((Span(start, stop),), ("hip.*",)).mask(recording(), place(fold))
    assert runs_of(hidden[:, 0]) == [(start, stop - start)]
    assert (hidden[:, 0] == hidden[:, 1]).all()
    assert not hidden[:, 2:].any()


def test_spans_beyond_the_recording_are_refused():
    with pytest.raises(HidingError, match=r"expected frames within its 80, got 70:90"):
        Spans((Span(70, 90),)).mask(recording(), place())


@given(share=st.floats(0.01, 0.99), seed=st.integers(0, 20))
def test_a_share_is_of_the_visible_entries_of_the_channels(share, seed):
    given_ = recording(gaps=[(10, 30, 1)])
    hidden = RandomEntries(share, ("hip.*",)).mask(given_, place(seed=seed))
    assert hidden.sum() == round(share * (80 + 60))
    assert not (hidden & ~given_.visible).any()
    assert not hidden[:, 2:].any()


@given(
    length=st.integers(1, 8),
    count=st.integers(1, 4),
    together=st.sampled_from(["all", "joint", "channel"]),
    seed=st.integers(0, 20),
)
def test_gaps_have_their_length_and_number_and_visible_neighbours(length, count, together, seed):
    given_ = recording(gaps=[(20, 25, 0), (70, 80, 3)])
    hidden = RandomGaps(length / RATE, count, together).mask(given_, place(seed=seed))
    assert not (hidden & ~given_.visible).any()
    runs = [(column, run) for column in range(4) for run in runs_of(hidden[:, column])]
    assert {n for _, (_, n) in runs} == {length}
    for column, (start, n) in runs:
        assert given_.visible[[start - 1, start + n], column].all()
        assert start > 0
        assert start + n < 80
    groups = {"all": [(0, 1, 2, 3)], "joint": [(0, 1), (2,), (3,)], "channel": list("0123")}
    owner = {int(c): group for group in groups[together] for c in group}
    assert len({(owner[column], run) for column, run in runs}) == count
    for group in groups[together]:
        columns = [int(c) for c in group]
        assert (hidden[:, columns] == hidden[:, columns[:1]]).all()


def test_gaps_that_have_no_room_are_refused():
    with pytest.raises(HidingError, match=r"expected 3 visible stretches of 0.5 s, 25 frames each"):
        RandomGaps(0.5, 3).mask(recording(), place())


PATTERN = recording(60, [(5, 15, 0), (40, 42, 2)], "pattern")


def test_the_first_fold_has_the_gaps_where_the_other_recording_has_them():
    hidden = SameGaps("shelf:other").mask(recording(), place(other=PATTERN))
    assert (hidden[:60] == ~PATTERN.visible).all()
    assert not hidden[60:].any()


@given(fold=st.integers(1, 5), n_frames=st.integers(20, 100), seed=st.integers(0, 10))
def test_later_folds_move_all_gaps_by_one_time(fold, n_frames, seed):
    hidden = SameGaps("shelf:other").mask(recording(n_frames), place(fold, seed, other=PATTERN))
    longer = max(n_frames, 60)
    whole = np.zeros((longer, 4), dtype=bool)
    whole[:60] = ~PATTERN.visible
    moved = [np.roll(whole, shift, axis=0)[:n_frames] for shift in range(longer)]
    assert hidden.any()
    assert any((hidden == candidate).all() for candidate in moved)


def test_folds_differ():
    for hiding in (RandomEntries(0.2), RandomGaps(0.1, 2), SameGaps("shelf:other")):
        masks = [hiding.mask(recording(), place(fold, other=PATTERN)) for fold in (1, 2)]
        assert (masks[0] != masks[1]).any()


def test_gaps_of_another_rate_or_of_none_are_refused():
    other = recording(60, [(5, 15, 0)], rate=100.0)
    with pytest.raises(HidingError, match=r"50 frames per second in shelf:other too, got 100"):
        SameGaps("shelf:other").mask(recording(), place(other=other))
    with pytest.raises(HidingError, match=r"expected gaps of its channels .* got none"):
        SameGaps("shelf:other").mask(recording(), place(other=recording(60)))


@pytest.mark.parametrize(
    "hiding",
    [Spans((Span(),), ("toe",)), RandomEntries(0.5, ("toe",)), RandomGaps(0.1, 1, "all", ("toe",))],
)
def test_channels_that_are_not_there_are_refused(hiding):
    with pytest.raises(HidingError, match=r"expected channels that match 'toe', got hip.x, hip.y"):
        hiding.mask(recording(), place())


def test_a_selection_takes_frames_and_channels():
    selected = Selection(Span(10, 30), ("hip.*", "sole")).of(recording())
    assert selected.channels == ("hip.x", "hip.y", "sole")
    assert (selected.times == recording().times[10:30]).all()
    assert Selection(channels=("hip",)).of(recording()).channels == ()  # whole names
