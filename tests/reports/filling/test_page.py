import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from mocapbench.basics.words import printable
from mocapbench.reports import FilledCurve, FilledPage, render_filled


def ranked(*errors):
    notes = ["chosen", "fitted to windows"]
    return pd.DataFrame({"model": ["linear", "hold"], "error, deg": errors, "": notes})


GAP = ("knee", "8-11", "0.4", "linear", "1.2 (0.9 to 1.6) deg", "1.3", "jumps", "--leave knee:8-11")


@pytest.fixture
def page():
    times = np.arange(20) / 10
    visible = np.sin(times)
    filled = np.full(20, np.nan)
    visible[8:12], filled[8:12] = np.nan, 0.8
    deviation = np.where(np.isnan(filled), np.nan, 0.1)
    curve = FilledCurve("knee.rx", "deg", times, visible, filled, deviation, ((0.7, 1.2),))
    return FilledPage(
        file="walk.csv",
        headline="linear filled 4 entries in 1 gap.",
        verdict=("longer, deg: linear leads hold by more than chance, over 9 held-out gaps.",),
        remarks=("1 longer gap was left open.",),
        faults=(("spikes", "KNEE", "frame 7 (0.07 s)", "40 mm"),),
        curves=(curve,),
        caption="The only gap.",
        gaps=pd.DataFrame([GAP], columns=[f"column {n}" for n in range(8)]),
        options="To leave a gap open, fill the file again with its option.",
        motion=None,
        rankings={"longer, deg: 9 held-out gaps": ranked(1.25, 13.5), "up to 1 s": ranked(4, 5)},
        left_out=(("mohgp", "took longer than 2 s"),),
        command="mocapbench fill walk.csv",
    )


def test_the_page_says_all_that_it_is_given(page):
    text = render_filled(page)
    said = [page.headline, *page.verdict, *page.remarks, page.command, "knee.rx", *page.rankings]
    said += [
        *page.faults[0],
        "1.25",
        "13.50",
        "error, deg",
        "fitted to windows",
        "mohgp",
        "took longer than 2 s",
    ]
    said += [*GAP, *page.gaps.columns, page.options, "1 gap of markers or joints"]
    assert [words for words in said if words not in text] == []


def test_the_page_loads_nothing_and_runs_nothing(page):
    text = render_filled(page)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert policy == "default-src 'none'; style-src 'unsafe-inline'"
    assert "<script" not in text
    assert not re.search(r'(?:src|href)="(?!#)', text)


def test_names_are_no_markup(page):
    hostile = "<b onclick=x>\x1b[31m\u202e"
    curve = replace(page.curves[0], channel=hostile)
    gaps = pd.DataFrame([[hostile] * 8])
    text = render_filled(replace(page, file=hostile, curves=(curve,), command=hostile, gaps=gaps))
    assert "<b onclick" not in text
    assert text == printable(text)


def test_the_same_page_gives_the_same_bytes(page):
    assert render_filled(page) == render_filled(page)


def test_without_held_out_gaps_there_is_no_ranking(page):
    heading = "How models were chosen"
    assert heading in render_filled(page)
    assert heading not in render_filled(replace(page, rankings={}, left_out=(), verdict=()))


def test_ids_are_unique(page):
    text = render_filled(replace(page, curves=page.curves * 3))
    ids = re.findall(r'\bid="([^"]*)"', text)
    assert len(ids) == len(set(ids))


def test_of_many_faults_twenty_are_listed_and_all_are_counted(page):
    faults = tuple(("spikes", f"M{k}.", "frame 7 (0.07 s)", "40 mm") for k in range(30))
    text = render_filled(replace(page, faults=faults))
    assert "20 of 30" in text
    assert "M19." in text
    assert "M20." not in text
    assert "What is wrong at gaps" not in render_filled(replace(page, faults=()))
