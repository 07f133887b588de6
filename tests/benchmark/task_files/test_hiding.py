from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark.task_files.hiding import (
    HidingError,
    HidingPlace,
    group_columns,
    hide_entries,
    hide_gaps,
    hide_same_gaps,
    hide_spans,
)
from mocapbench.benchmark.task_files.selection import select_part
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
    hidden = hide_spans(recording(), place(fold), ((start, stop),), ("hip.*",))
    assert runs_of(hidden[:, 0]) == [(start, stop - start)]
    assert (hidden[:, 0] == hidden[:, 1]).all()
    assert not hidden[:, 2:].any()


def test_spans_beyond_the_recording_are_refused():
    with pytest.raises(HidingError, match=r"expected frames within its 80, got 70:90"):
        hide_spans(recording(), place(), ((70, 90),))


@given(share=st.floats(0.01, 0.99), seed=st.integers(0, 20))
def test_a_share_is_of_the_visible_entries_of_the_channels(share, seed):
    given_ = recording(gaps=[(10, 30, 1)])
    hidden = hide_entries(given_, place(seed=seed), share, ("hip.*",))
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
    hidden = hide_gaps(
        given_, place(seed=seed), length / RATE, count, partial(group_columns, together=together)
    )
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
        hide_gaps(recording(), place(), 0.5, 3, group_columns)


PATTERN = recording(60, [(5, 15, 0), (40, 42, 2)], "pattern")


def test_the_first_fold_has_the_gaps_where_the_other_recording_has_them():
    hidden = hide_same_gaps(recording(), place(other=PATTERN), "shelf:other")
    assert (hidden[:60] == ~PATTERN.visible).all()
    assert not hidden[60:].any()


@given(fold=st.integers(1, 5), n_frames=st.integers(20, 100), seed=st.integers(0, 10))
def test_later_folds_move_all_gaps_by_one_time(fold, n_frames, seed):
    hidden = hide_same_gaps(recording(n_frames), place(fold, seed, other=PATTERN), "shelf:other")
    longer = max(n_frames, 60)
    whole = np.zeros((longer, 4), dtype=bool)
    whole[:60] = ~PATTERN.visible
    moved = [np.roll(whole, shift, axis=0)[:n_frames] for shift in range(longer)]
    assert hidden.any()
    assert any((hidden == candidate).all() for candidate in moved)


def test_folds_differ():
    for hide in (
        partial(hide_entries, share=0.2),
        partial(hide_gaps, seconds=0.1, count=2, group=group_columns),
        partial(hide_same_gaps, uri="shelf:other"),
    ):
        masks = [hide(recording(), place(fold, other=PATTERN)) for fold in (1, 2)]
        assert (masks[0] != masks[1]).any()


def test_gaps_of_another_rate_or_of_none_are_refused():
    other = recording(60, [(5, 15, 0)], rate=100.0)
    with pytest.raises(HidingError, match=r"50 frames per second in shelf:other too, got 100"):
        hide_same_gaps(recording(), place(other=other), "shelf:other")
    with pytest.raises(HidingError, match=r"expected gaps of its channels .* got none"):
        hide_same_gaps(recording(), place(other=recording(60)), "shelf:other")


@pytest.mark.parametrize(
    "hide",
    [
        partial(hide_spans, spans=((0, None),), channels=("toe",)),
        partial(hide_entries, share=0.5, channels=("toe",)),
        partial(hide_gaps, seconds=0.1, count=1, group=partial(group_columns, channels=("toe",))),
    ],
)
def test_channels_that_are_not_there_are_refused(hide):
    with pytest.raises(HidingError, match=r"expected channels that match 'toe', got hip.x, hip.y"):
        hide(recording(), place())


def test_a_selection_takes_frames_and_channels():
    selected = select_part(recording(), (10, 30), ("hip.*", "sole"))
    assert selected.channels == ("hip.x", "hip.y", "sole")
    assert (selected.times == recording().times[10:30]).all()
    assert select_part(recording(), channels=("hip",)).channels == ()  # whole names
