"""The page of a filled file: which figures of its motion are filled."""

from dataclasses import replace
from pathlib import Path

import format_files
import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.halving import Contender
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.filled_recording import FilledRecording
from mocapbench.benchmark.filling.gap_problem import PredictedEntries
from mocapbench.benchmark.filling.gap_table import tabulate_gaps
from mocapbench.benchmark.filling.input_files import InputFile
from mocapbench.benchmark.filling.page import compose_page
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.datasets import AcclaimFormat, CSVFormat, Recording
from mocapbench.reports import render_filled

KIND = Kind("", "one marker or joint", "up to 0.25 s")


def page_for(whole, target, values, path=Path("waves.csv"), file_format=None):
    """Return the page of a file of which the target was filled with these values."""
    n = int(target.sum())
    request = FillRequest(whole.hide(target), target, np.full(n, "one"))
    prediction = PredictedEntries(values[target], np.ones(n))
    filled = FilledRecording(
        *(request, prediction, request.models, np.zeros(n, dtype=int), (KIND,)),
        None,
        {},
        {"one": 0},
    )
    input_file = InputFile(path, file_format or CSVFormat(), request, request.given)
    return compose_page(input_file, filled, tabulate_gaps(filled), "fill")


@pytest.mark.parametrize("length", [1, 2, 4, 5, 12, 30])
@pytest.mark.parametrize("start", [0, 1, 20])
def test_figures_show_filled_frames_and_frames_of_the_file_beside_them(tmp_path, start, length):
    walk, path = format_files.walk(), tmp_path / "walker.amc"
    format_files.write_acclaim(path, walk)
    target = np.zeros(walk.values.shape, dtype=bool)
    target[start : start + length, 10] = True
    panel = page_for(walk, target, walk.values, path, AcclaimFormat()).motion
    groups = [curve.group for curve in panel.curves]
    assert {*groups} == {"filled", "in the file"}
    assert groups[-1] == "in the file"
    assert (groups[0] == "filled") == (start == 0)


def page_of_many(whole, hidden, longest, jump):
    """Return the page of 30 short gaps, of which one is longer and one jumps in one channel."""
    blocks = [(20 + 30 * n, 22 + 30 * n, [0, 1, 2, 3]) for n in range(30)]
    target = hidden(*blocks, (longest, longest + 20, [0, 1, 2, 3]), n_frames=1000)
    values = whole.values.copy()
    values[jump : jump + 2, 3] += 100.0
    return page_for(whole, target, values)


def test_the_gap_that_jumps_and_the_longest_are_drawn(waves, hidden):
    """Of many gaps a few are drawn, but those that a remark names are among them."""
    whole = waves(1000)
    page = page_of_many(whole, hidden, longest=770, jump=140)
    spans = {(curve.channel, span[0]) for curve in page.curves for span in curve.gaps}
    assert ("root.ty", whole.times[139]) in spans
    assert whole.times[769] in {start for _, start in spans}
    assert "4 of 30 gaps, the longest among them" in page.caption


def test_the_channel_that_jumps_is_drawn_however_little_it_moves():
    rng = np.random.default_rng(0)
    values = 50.0 * np.sin(np.arange(100) / 9)[:, None] + np.arange(8.0)
    values[:, 5] = 0.01 * rng.normal(size=100)
    channels = tuple("abcdefgh")
    whole = Recording("r", np.arange(100) / 50, values, channels, ("deg",) * 8)
    target = np.zeros(values.shape, dtype=bool)
    target[40:60] = True
    filled = values.copy()
    filled[40:60, 5] += 3.0
    page = page_for(whole, target, filled)
    assert page.curves[0].channel == "f"
    assert "f by" in " ".join(page.remarks)


def test_gaps_of_the_whole_file_are_drawn(waves, hidden):
    whole = waves(1000)
    page = page_of_many(whole, hidden, longest=110, jump=50)
    starts = {curve.gaps[0][0] for curve in page.curves}
    assert {whole.times[49], whole.times[109], whole.times[889]} <= starts


def page_of_choice(filled):
    input_file = InputFile(Path("waves.csv"), CSVFormat(), filled.request, filled.request.given)
    return compose_page(input_file, filled, tabulate_gaps(filled), "fill")


def test_the_ranking_notes_the_choice_and_over_whom_its_lead_may_be_chance(filled, choice_of):
    choice = choice_of({"one": [1, 2, 1, 2, 1], "two": [2, 1, 2, 1.5, 1], "bad": [9] * 5})
    page = page_of_choice(filled(choice))
    ((title, table),) = page.rankings.items()
    assert title == "one marker or joint, up to 0.25 s, deg: 5 held-out gaps"
    assert [*table.columns] == ["model", "error, deg", ""]
    (ranking,) = choice.rankings.values()
    assert dict(zip(table["model"], table["error, deg"], strict=True)) == ranking.means
    assert [*table[""]] == [
        "chosen, fitted to windows",
        "lead of one may be chance, fitted to windows",
        "fitted to windows",
    ]
    assert "error, deg" in render_filled(page)


def test_a_kind_of_which_another_model_filled_does_not_note_the_first_as_chosen(filled, choice_of):
    choice = choice_of({"two": [1, 2], "one": [2, 3]})
    (table,) = page_of_choice(filled(choice)).rankings.values()
    assert [*table[""]] == ["fitted to windows", "chosen, fitted to windows"]


def test_a_model_without_a_rank_is_listed_with_why(filled, choice_of):
    choice = choice_of({"one": [1, 2]})
    slow = Contender("slow", [None], "erred twice as far")
    choice = replace(choice, contenders=(*choice.contenders, slow), too_dear=("dear",))
    page = page_of_choice(filled(choice))
    assert page.left_out == (
        ("slow", "erred twice as far"),
        ("dear", "would take more work than --effort allows, to fill the file"),
    )


def test_a_page_of_a_named_model_has_no_ranking(filled):
    page = page_of_choice(filled())
    assert not page.rankings
    assert not page.left_out
    assert "How models were chosen" not in render_filled(page)
