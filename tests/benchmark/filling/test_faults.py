"""Faults that touch a gap to fill are said; spikes may be hidden, and are then gaps."""

import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mocapbench.benchmark import Reading
from mocapbench.benchmark.filling.faults import (
    describe_faults,
    find_faults_at_gaps,
    tabulate_faults,
)
from mocapbench.benchmark.filling.input_files import read_input_files
from mocapbench.benchmark.filling.requests.request import NamedEntries, select
from mocapbench.benchmark.recording_checks import tell_spikes
from mocapbench.datasets import Recording

NAMES = [f"M{k}" for k in range(8)]


def move():
    """Return positions (300, 8, 3) of markers of a body that walks and swings, with noise."""
    times = np.arange(300)[:, None, None] / 120
    places = np.array([[x, 150.0 * k, 200.0 * k] for k in range(4) for x in (0.0, 300.0)])
    swing = 80 * np.sin(6 * times + np.arange(8)[:, None] // 4 + np.arange(3))
    noise = np.random.default_rng(0).normal(0, 0.3, (300, 8, 3))
    return places + swing + np.array([1200.0, 0.0, 0.0]) * times + noise


def record(positions, names=NAMES):
    channels = [f"{name}.{axis}" for name in names for axis in "xyz"]
    times = np.arange(len(positions)) / 120
    return Recording("walk", times, positions.reshape(len(times), -1), channels, ["mm"] * 24)


def list_faults(positions, names=NAMES, **entries):
    request = select(record(positions, names), NamedEntries(**entries))
    return [(f["kind"], *f["markers"], f["start"]) for f in find_faults_at_gaps(request)]


def test_only_faults_beside_gaps_of_the_same_marker_are_said():
    positions = move()
    positions[100:110, 2] = np.nan
    positions[98:100, 2] += 60.0  # beside the gap
    positions[115, 4] += 60.0  # of another marker
    positions[200, 2] += 60.0  # elsewhere
    assert list_faults(positions) == [("spike", "M2", 98)]


def test_a_swap_across_a_gap_comes_before_spikes():
    positions = move()
    positions[30:40, 1] = np.nan
    positions[28:30, 1] += 60.0
    positions[100:, [2, 5]] = positions[100:, [5, 2]]
    positions[100:120, [2, 5]] = np.nan
    assert list_faults(positions) == [("swap", "M2", "M5", 120), ("spike", "M1", 28)]


def test_gaps_that_stay_open_and_unlabelled_markers_count_for_nothing():
    positions = move()
    positions[100:110, 2] = positions[150:160, 0] = np.nan
    positions[98:100, 2] += 60.0
    assert list_faults(positions, channels=("M0",)) == []
    assert list_faults(positions, names=["M0", "M1", "*3", *NAMES[3:]]) == []


def test_a_sentence_and_a_row_say_each_fault():
    positions = move()
    positions[100:110, 2] = np.nan
    positions[98:100, 2] += 60.0
    faults = find_faults_at_gaps(select(record(positions), NamedEntries()))
    (said,) = describe_faults(faults)
    assert said.startswith("Spikes, at gaps: M2: frames 98 to 99 (2, from 0.82 s), 10")
    assert "--hide-spikes" in said
    assert [row[:3] for row in tabulate_faults(faults)] == [
        ("spikes", "M2", "frames 98 to 99 (2, from 0.82 s)")
    ]


def test_all_three_coordinates_of_a_spike_are_hidden_and_counted():
    positions = move()
    positions[98:100, 2, 0] += 80.0
    mask, (said,) = tell_spikes(record(positions))
    assert np.argwhere(mask).tolist() == [[n, c] for n in (98, 99) for c in (6, 7, 8)]
    assert said == "1 spike of M2 is hidden (6 entries), as --hide-spikes says."


def test_nothing_is_hidden_unless_it_is_asked_for_nor_in_results_of_a_model():
    positions = move()
    positions[98:100, 2] += 80.0
    recording, results = record(positions), ["M2.x", "M2.y", "M2.z"]
    assert not Reading().find_spikes(recording, ())[0].any()
    assert Reading(spikes=tell_spikes).find_spikes(recording, ())[0].any()
    assert not Reading(spikes=tell_spikes).find_spikes(recording, results)[0].any()


@pytest.fixture
def spiky(tmp_path):
    """Return a table with a gap, a spike beside it and one elsewhere."""
    positions = move()
    positions[100:110, 2] = np.nan
    positions[98:100, 2] += 60.0
    positions[200, 4] += 60.0
    names = [f"{name}.{axis} [mm]" for name in NAMES for axis in "xyz"]
    table = pd.DataFrame(positions.reshape(300, -1), columns=names)
    table.insert(0, "time", np.arange(300) / 120)
    path = tmp_path / "walk.csv"
    table.to_csv(path, index=False)
    return path


def read_to_fill(path, train, reading):
    """Return what is to be filled of a file, as the command reads it."""
    ((source,), refused) = read_input_files(
        [path], [train], reading, NamedEntries(), lambda _: None
    )
    assert not refused
    return source


def test_spikes_of_files_to_learn_from_are_hidden_with_those_to_fill(spiky, tmp_path):
    train = tmp_path / "other.csv"
    shutil.copy(spiky, train)
    hiding = read_to_fill(spiky, train, Reading(spikes=tell_spikes))
    (learned,) = hiding.request.train
    assert np.isnan(learned.values[98:100, 6:9]).all()
    assert np.isnan(learned.values[200, 12:15]).all()
    assert np.isnan(learned.values).sum() == 30 + 9
    assert any(
        text == "other.csv: 2 spikes of M2 and M4 are hidden (9 entries), as --hide-spikes says."
        for text in hiding.remarks
    )
    plain = read_to_fill(spiky, train, Reading())
    assert np.isnan(plain.request.train[0].values).sum() == 30
    assert plain.remarks == ()


def test_files_to_learn_from_without_spikes_are_not_mentioned(spiky, tmp_path):
    train = tmp_path / "other.csv"
    pd.read_csv(spiky).drop(index=[98, 99, 200]).assign(time=np.arange(297) / 120).to_csv(
        train, index=False
    )
    source = read_to_fill(spiky, train, Reading(spikes=tell_spikes))
    assert not any("other.csv" in text for text in source.remarks)


@pytest.mark.slow
@pytest.mark.parametrize(("option", "marked"), [((), 0), (("--hide-spikes",), 9)])
def test_the_table_marks_entries_that_were_spikes(cli, spiky, tmp_path, option, marked):
    out = tmp_path / "out"
    assert cli("fill", spiky, "--model", "linear", "--out", out, *option) == 0
    entries = pd.read_csv(out / "walk.csv.entries.csv")
    assert (len(entries), entries["spike"].sum()) == (30 + marked, marked)
    spikes = {*zip(entries["frame"], entries["channel"], strict=True)} if option else set()
    assert (200, "M4.x") in spikes or not option
    assert ("Spikes, at gaps: M2" in cli.printed) is not bool(option)
    assert ("2 spikes of M2 and M4 are hidden (9 entries)" in cli.printed) is bool(option)
    page = Path(out / "walk.csv.html").read_text(encoding="utf-8")
    assert ("What is wrong at gaps" in page) is not bool(option)
