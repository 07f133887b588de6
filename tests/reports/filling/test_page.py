import re
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.reports import FilledCurve, FilledPage, render_filled


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
        verdict="Its lead over hold is more than chance, over 9 held-out gaps.",
        remarks=("1 longer gap was left open.",),
        curves=(curve,),
        caption="The only gap.",
        motion=None,
        units=("deg",),
        n_gaps=9,
        errors={"linear": 0.5, "hold": 1.5},
        rmse={"linear": {"deg": 1.25}, "hold": {"deg": 3.25}},
        seconds={"linear": 0.1, "hold": 0.1},
        notes={"linear": "chosen", "hold": ""},
        left_out=(("mohgp", "took longer than 2 s"),),
        command="mocapbench fill walk.csv",
    )


def test_the_page_says_all_that_it_is_given(page):
    text = render_filled(page)
    said = [page.headline, page.verdict, *page.remarks, page.command, "knee.rx", "9 held-out gaps"]
    said += ["1.25", "3.25", "mohgp", "took longer than 2 s"]
    assert [words for words in said if words not in text] == []


def test_the_page_loads_nothing_and_runs_nothing(page):
    text = render_filled(page)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert policy == "default-src 'none'; style-src 'unsafe-inline'"
    assert "<script" not in text
    assert not re.search(r'(?:src|href)="(?!#)', text)


def test_names_are_no_markup(page):
    hostile = "<b onclick=x>\x1b[31m"
    curve = replace(page.curves[0], channel=hostile)
    text = render_filled(replace(page, file=hostile, curves=(curve,), command=hostile))
    assert "<b onclick" not in text
    assert "\x1b" not in text


def test_the_same_page_gives_the_same_bytes(page):
    assert render_filled(page) == render_filled(page)


def test_without_held_out_gaps_there_is_no_ranking(page):
    text = render_filled(replace(page, errors={}, left_out=(), verdict="", n_gaps=0))
    assert "How the model was chosen" not in text


def test_ids_are_unique(page):
    text = render_filled(replace(page, curves=page.curves * 3))
    ids = re.findall(r'\bid="([^"]*)"', text)
    assert len(ids) == len(set(ids))
