"""The numbers on pages are those of the papers' tables and of the stored reference values."""

import csv
from pathlib import Path

import pandas as pd
import pytest

from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.reports.paper.published import every_value

ROOT = Path(__file__).parents[2]
REFERENCES = {"oracle", "control", "replay"}


def _published(name):
    path = ROOT / "reports" / "paper" / "published.csv"
    with path.open(encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(file) if row["task"] == name]


def _title(source):
    paper, *place = source.split("-")
    short = {"gpdm": "GPDM", "hlm": "HLM", "lawrence": "Lawrence", "taylor": "Taylor"}
    name = paper if paper == "thesis" else paper.capitalize()
    return " ".join([short.get(paper, name), *(part.lstrip("0") for part in place)])


@pytest.mark.parametrize("name", sorted({value.task for value in every_value()}))
def test_published_values_are_those_of_the_report(texts, tables, name):
    shown = {}
    for title, (head, *rows) in tables(texts["tasks"][name]):
        for case, *cells in rows:
            for column, cell in zip(head[1:], cells, strict=True):
                shown[title, case, column] = cell.partition(" (")[0]
    wanted = _published(name)
    for row in wanted:
        spread = f" ± {float(row['two_sd']):g}" if row["two_sd"] else ""
        address = _title(row["source"]), row["case"], f"{row['model']}, {row['metric']}"
        assert shown[address] == f"{float(row['value']):g}{spread}"
    titles = {_title(row["source"]) for row in wanted}
    assert sum(bool(cell) for (title, *_), cell in shown.items() if title in titles) == len(wanted)


def test_remarks_on_published_values_are_on_the_page(texts):
    for value in every_value():
        text = texts["tasks"][value.task].replace("\\", "")
        assert value.erratum in text
        assert value.not_comparable in text


def _means(path, task):
    """Return the mean loss and the mean of each label by the task's first metric."""
    metric = TASKS.get(task).page.metrics[0]
    frame = pd.read_csv(path, comment="#")
    frame = frame[frame["metric"] == metric]
    folds = frame.filter(like="fold ").mean(axis=1)
    by_case = frame.assign(mean=folds).pivot(index="label", columns="case", values="mean")
    cases = {case.name: case for case in TASKS.get(task).cases}
    competing = by_case.drop(index=[n for n in by_case.index if n in REFERENCES])
    scored = competing.dropna(axis=1, how="all").columns
    recorded = [name for name in scored if not cases[name].synthetic] or list(scored)
    single = [n for n in recorded if not TASKS.get(task).averages_references(cases[n])]
    return by_case[single or recorded]


@pytest.mark.parametrize("name", TASKS.names())
def test_rankings_are_those_of_the_stored_values(texts, tables, goldens, name):
    stored = (goldens / profile / f"{name}.csv" for profile in ("quick", "smoke"))
    means = _means(next(path for path in stored if path.exists()), name)
    found = [
        rows for _, rows in tables(texts["tasks"][name]) if rows[0][:2] == ["place", "entrant"]
    ]
    if set(means.index) <= REFERENCES:
        assert not found
        return
    ((_, *rows),) = found
    assert sorted(label for _, label, *_ in rows) == sorted(means.index)
    whole = means.dropna().mean(axis=1)
    for _, label, text, *_ in rows:
        if label in whole:
            half = 0.5 * 10.0 ** -len(text.partition(".")[2])
            assert float(text.replace("−", "-")) == pytest.approx(whole[label], abs=1.000001 * half)
    places = [(place, label) for place, label, *_ in rows if place != "–"]
    assert [place for place, _ in places] == [str(1 + i) for i in range(len(places))]
    metric = METRICS.get(TASKS.get(name).page.metrics[0])
    losses = [metric.loss(whole[label]) for _, label in places if label in whole]
    assert losses == sorted(losses)


def test_the_places_of_a_model_are_those_of_its_tasks(texts, tables):
    """Entrants, places and means, from one kind of page to the other."""
    in_tasks = {
        (TASKS.get(name).page.short, label, place, mean)
        for name in TASKS.names()
        for _, (head, *rows) in tables(texts["tasks"][name])
        if head[:2] == ["place", "entrant"]
        for place, label, mean, *_ in rows
    }
    in_models = {
        (task, label, "–" if place == "not ranked" else place.split()[0], mean.split()[0])
        for name in MODELS.names()
        for _, (head, *rows) in tables(texts["models"][name])
        if head[:2] == ["task", "entrant"]
        for task, label, place, _, mean, *_ in rows
    }
    assert in_models == in_tasks


def test_wins_of_a_model_come_first(texts, tables):
    for name in MODELS.names():
        for _, (head, *rows) in tables(texts["models"][name]):
            if head[:2] == ["task", "entrant"]:
                places = [row[2].split(" of ") for row in rows if row[2] != "not ranked"]
                shares = [int(place) / int(n) for place, n in places]
                assert shares == sorted(shares)
