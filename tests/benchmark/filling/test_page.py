"""The page of a filled file: which figures of its motion are filled."""

from pathlib import Path

import format_files
import numpy as np
import pytest

from mocapbench.benchmark.filling.filler import Filled
from mocapbench.benchmark.filling.page import page_of
from mocapbench.benchmark.filling.question import FilledEntries
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.benchmark.filling.sources import Source
from mocapbench.datasets import AcclaimFormat, CSVFormat, Recording


def page_for(whole, target, filled):
    """Return the page of a file of which the target was filled with these values."""
    source = Source(Path("waves.csv"), CSVFormat(), FillRequest(whole.hide(target), target, ()), ())
    answer = FilledEntries(filled[target], np.ones(int(target.sum())))
    return page_of(Filled(source, "one", answer, 0, None, ()), "mocapbench fill")


@pytest.mark.parametrize("length", [1, 2, 4, 5, 12, 30])
@pytest.mark.parametrize("start", [0, 1, 20])
def test_figures_show_filled_frames_and_frames_of_the_file_beside_them(tmp_path, start, length):
    walk, path = format_files.walk(), tmp_path / "walker.amc"
    format_files.write_acclaim(path, walk)
    target = np.zeros(walk.values.shape, dtype=bool)
    target[start : start + length, 10] = True
    source = Source(path, AcclaimFormat(), FillRequest(walk.hide(target), target, ()), ())
    answer = FilledEntries(walk.values[target], np.ones(length))
    panel = page_of(Filled(source, "one", answer, 0, None, ()), "mocapbench fill").motion
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
