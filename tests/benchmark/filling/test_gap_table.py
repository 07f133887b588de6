"""The table of filled gaps: where each is, what is expected there, and how to leave it open."""

import shlex
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy import stats

from mocapbench.benchmark.filling.choosing.choice import Choice
from mocapbench.benchmark.filling.choosing.hold_outs import make_hold_outs
from mocapbench.benchmark.filling.choosing.kinds import tell_kinds
from mocapbench.benchmark.filling.choosing.ranking import number_positions, rank
from mocapbench.benchmark.filling.choosing.scores import list_gaps, weigh_gaps
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.gap_table import describe_gaps, sort_by_caution, tabulate_gaps
from mocapbench.benchmark.filling.jumps import find_jumps
from mocapbench.benchmark.filling.requests.names import match_pattern
from mocapbench.benchmark.filling.requests.request import NamedEntries, select
from mocapbench.datasets import Recording

CHANNELS = ("LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "RKNE.y", "RKNE.z", "hip.rx", "hip.ry")
UNITS = ("mm",) * 6 + ("deg",) * 2


def record_waves(n_frames=400, channels=CHANNELS, units=UNITS):
    times = np.arange(n_frames) / 100
    phases = 0.7 * np.arange(len(channels))
    values = 20 * np.sin(2 * np.pi * times[:, None] * (0.5 + phases / 5) + phases)
    return Recording("waves", times, values, channels, units)


def hide(*blocks, n_frames=400, n_channels=8):
    mask = np.zeros((n_frames, n_channels), dtype=bool)
    for first, stop, channels in blocks:
        mask[first:stop, channels] = True
    return mask


def fill_with(recording, mask, models="linear", choose=None, values=None):
    """Return a recording filled with its own values, or with others, as if by these models."""
    request = select(recording.hide(mask), NamedEntries(fill_ends=True))
    target = request.target
    all_kinds, kinds = number_kinds(request)
    mean = (recording.values if values is None else values)[target]
    return FilledRecording(
        request,
        PredictedEntries(mean, None),
        np.broadcast_to(models, mean.shape).astype(str),
        kinds,
        all_kinds,
        choose(request) if choose else None,
        {},
        {},
    )


def number_kinds(request):
    """Return the kinds of gaps, and the number of that of each entry to fill."""
    kinds = tell_kinds(request.problem)
    all_kinds = sorted({kind for of_gap in kinds.values() for kind in of_gap})
    numbers = np.zeros(request.target.shape, dtype=int)
    for gap, of_gap in kinds.items():
        for kind, channels in of_gap.items():
            numbers[gap.start : gap.stop, list(channels)] = all_kinds.index(kind)
    return tuple(all_kinds), numbers[request.target]


def choose_by_chance(request, models=("linear", "makima"), n_hold_outs=None):
    """Return a choice among models whose errors in held-out gaps are random numbers."""
    rng = np.random.default_rng(0)
    hold_outs = tuple(make_hold_outs(request.problem, rng)[:n_hold_outs])
    gaps = list_gaps(hold_outs)
    rankings = {}
    for kind in {gap.kind for gap in gaps}:
        of_kind = [gap for gap in gaps if gap.kind == kind]
        errors = {model: rng.uniform(1, 2, len(of_kind)) for model in models}
        rankings[kind] = rank(errors, weigh_gaps(of_kind), number_positions(of_kind))
    return Choice(rankings, hold_outs, ())


GAPS = (
    (50, 60, [0, 1, 2]),
    (55, 70, [3, 4, 5]),
    (100, 110, [0, 1, 2, 6, 7]),
    (150, 155, [0, 1]),
    (200, 230, [7]),
    (390, 400, [3, 4, 5]),
)


def mask_row(row, recording):
    """Return the entries (N, D) of a row, as its columns name them."""
    names = row.marker.split(", ")
    channels = np.any([match_pattern(recording.channels, name) for name in names], axis=0)
    mask = np.zeros(recording.values.shape, dtype=bool)
    mask[row.first : row.last + 1] = channels & (np.array(recording.units) == row.unit)
    return mask


@pytest.mark.parametrize("models", [["linear"], ["linear", "makima"]])
def test_every_filled_entry_is_in_exactly_one_row(models):
    recording, mask = record_waves(), hide(*GAPS)
    by_frame = np.array([models[n // 53 % len(models)] for n in range(400)])
    filled = fill_with(recording, mask, by_frame[np.nonzero(mask)[0]])
    counts = np.zeros(mask.shape, dtype=int)
    for row in tabulate_gaps(filled).itertuples():
        of_row = mask_row(row, recording)
        assert {row.model} == {*filled.models[of_row[mask]]}
        counts += of_row
    np.testing.assert_array_equal(counts, mask)


def test_rows_are_named_by_marker_joint_or_channels():
    table = tabulate_gaps(fill_with(record_waves(), hide(*GAPS)))
    rows = [*zip(table["marker"], table["unit"], table["first"], table["last"], strict=True)]
    assert rows == [
        ("LKNE", "mm", 50, 59),
        ("RKNE", "mm", 55, 69),
        ("LKNE", "mm", 100, 109),
        ("hip", "deg", 100, 109),
        ("LKNE.x, LKNE.y", "mm", 150, 154),
        ("hip.ry", "deg", 200, 229),
        ("RKNE", "mm", 390, 399),
    ]
    np.testing.assert_allclose(table["seconds"], (table["last"] - table["first"] + 1) / 100)


def test_the_rules_of_a_row_name_its_entries_and_no_others():
    names = (
        *("A*.x", "A*.y", "A*.z", "AB.x", "AB.y", "AB.z"),
        *("it's, 1:2-3.rx", "it's, 1:2-3.ty"),
    )
    units = (*UNITS[:6], "deg", "cm")
    recording, mask = record_waves(channels=names, units=units), hide(*GAPS)
    filled = fill_with(recording, mask)
    table = tabulate_gaps(filled)
    options = [shlex.split(option) for option in describe_gaps(table)["leave it open by"]]
    assert options == [["--leave", rules] for rules in table["leave"]]
    assert table["leave"][0] == "A[*]:50-59"
    for row in table.itertuples():
        left = np.zeros(mask.shape, dtype=bool)
        for rule in row.leave.split(","):
            pattern, _, frames = rule.rpartition(":")
            first, last = map(int, frames.split("-"))
            left[first : last + 1] |= match_pattern(names, pattern)
        np.testing.assert_array_equal(left & mask, mask_row_of(row, recording, mask))


def mask_row_of(row, recording, mask):
    """Return the hidden entries of the unit in the frames of a row that are hidden throughout."""
    within = mask[row.first : row.last + 1]
    beside = mask[[row.first - 1, (row.last + 1) % len(mask)]].any(axis=0)
    channels = within.all(axis=0) & ~beside & (np.array(recording.units) == row.unit)
    owners = [name in row.marker for name in (n.rpartition(".")[0] for n in recording.channels)]
    of_row = np.zeros(mask.shape, dtype=bool)
    of_row[row.first : row.last + 1] = channels & np.array(owners)
    return of_row


def test_the_expected_error_is_the_mean_over_held_out_gaps_with_the_interval_of_students_t():
    choose = partial(choose_by_chance, n_hold_outs=1)  # in one hold-out no copies overlap
    filled = fill_with(record_waves(), hide((50, 53, [0])), choose=choose)
    ((kind, ranking),) = filled.choice.rankings.items()
    assert ranking.n_positions == ranking.n_gaps >= 5
    (row,) = tabulate_gaps(filled).itertuples()
    errors = ranking.errors["linear"]
    half = stats.t(len(errors) - 1).ppf(0.975) * errors.std(ddof=1) / np.sqrt(len(errors))
    assert row.kind == str(kind)
    assert row.error == pytest.approx(errors.mean())
    assert (row.low, row.high) == pytest.approx((errors.mean() - half, errors.mean() + half))


def test_a_model_that_was_not_compared_has_no_expected_error():
    mask = hide((50, 60, [0]))
    named = tabulate_gaps(fill_with(record_waves(), mask))
    other = tabulate_gaps(fill_with(record_waves(), mask, "knn", choose_by_chance))
    for table in (named, other):
        assert table[["error", "low", "high"]].isna().to_numpy().all()


def test_of_few_positions_no_interval_is_given():
    filled = fill_with(record_waves(), hide((50, 150, [0, 1, 2])), choose=choose_by_chance)
    (ranking,) = filled.choice.rankings.values()
    assert ranking.n_positions < 5
    (row,) = tabulate_gaps(filled).itertuples()
    assert row.error == pytest.approx(ranking.means["linear"])
    assert np.isnan([row.low, row.high]).all()


def test_all_jumps_are_named_and_the_largest_is_measured():
    recording, mask = record_waves(), hide(*GAPS)
    values = recording.values.copy()
    values[mask] += np.where(np.nonzero(mask)[0] < 60, 500.0, 0.0)
    filled = fill_with(recording, mask, values=values)
    table, jumps = tabulate_gaps(filled), find_jumps(filled.recording, mask)
    said = "; ".join(table["caution"])
    assert len(jumps) == 2 * (3 + 3) - 3  # those at frame 60 lead to frames that are filled alike
    for frame, channel in zip(jumps["frame"], jumps["channel"], strict=True):
        assert f"{CHANNELS[channel]} at frame {frame}" in said
    relative = jumps["size"] / jumps["largest"]
    assert table["jump"].max() == pytest.approx(relative.max())
    assert (table["jump"] > 1.25).tolist() == ["jumps" in row for row in table["caution"]]


def test_cautions_are_said_in_plain_words():
    recording = record_waves(120)
    mask = hide((0, 20, [0, 1, 2]), (40, 50, [3, 4, 5]), (5, 118, [7]), n_frames=120)
    values = recording.values.copy()
    values[44:46, 3] += 300.0
    table = tabulate_gaps(fill_with(recording, mask, values=values)).set_index("marker")
    assert table["caution"]["LKNE"] == "at an end, with visible frames on one side only"
    assert table["caution"]["hip.ry"].startswith("only 7 visible frames to learn from")
    assert "extrapolates RKNE.x by " in table["caution"]["RKNE"]
    assert "jumps" not in table["caution"]["RKNE"]


def test_a_gap_longer_than_its_copies_is_doubtful():
    filled = fill_with(record_waves(), hide((100, 300, [0, 1, 2])), choose=choose_by_chance)
    (row,) = tabulate_gaps(filled).itertuples()
    longest = max(len(gap.copy) for gap in list_gaps(filled.choice.hold_outs))
    assert longest < 200
    assert f"longer than any held-out gap of its kind ({longest} frames)" in row.caution
    lacking = replace(filled, choice=replace(filled.choice, hold_outs=(), rankings={}))
    assert "no held-out gap of its kind" in tabulate_gaps(lacking)["caution"][0]
    as_long = fill_with(record_waves(), hide((100, 120, [0, 1, 2])), choose=choose_by_chance)
    assert tabulate_gaps(as_long)["caution"].tolist() == [""]


def test_gaps_with_most_cautions_come_first_and_of_these_the_longest():
    table = tabulate_gaps(fill_with(record_waves(), hide(*GAPS)))
    ordered = sort_by_caution(table)
    counts = [len(list(filter(None, text.split("; ")))) for text in ordered["caution"]]
    assert counts == sorted(counts, reverse=True)
    assert ordered["first"].tolist()[:2] == [390, 200]
    assert sorted(ordered["first"]) == sorted(table["first"])
