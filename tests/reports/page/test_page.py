import json
import re
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise

import pandas as pd
import pytest

from mocapbench.reports import CaseLayout, RowNotes, render
from mocapbench.reports.text import cell_anchor


class Outline(HTMLParser):
    """The elements of a page, in order."""

    def __init__(self, text):
        super().__init__()
        self.elements = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def of(self, *tags):
        return [attributes for tag, attributes in self.elements if tag in tags]


@pytest.fixture(scope="module")
def outline(page):
    return Outline(page)


def test_the_same_bundle_gives_the_same_bytes(bundle, page):
    assert render(bundle) == page


def test_headings_start_with_one_h1_and_skip_no_level(outline):
    levels = [int(tag[1]) for tag, _ in outline.elements if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def cell_addresses(page):
    """Return the addresses of the cells that the page knows."""
    blob = re.search(r'<script type="application/json" id="cells">(.*?)</script>', page, re.S)
    document = json.loads(blob.group(1))
    return {
        f"#{cell_anchor(task, *(document['shared'][place] for place in row[:2]))}"
        for task, about in document["tasks"].items()
        for row in about["rows"]
    }


def test_ids_are_unique_and_every_link_leads_somewhere(outline, page):
    ids = Counter(attributes["id"] for _, attributes in outline.elements if "id" in attributes)
    assert set(ids.values()) == {1}
    named = [attributes for _, attributes in outline.elements]
    targets = {link["href"] for link in outline.of("a")}
    assert targets <= {f"#{name}" for name in ids} | cell_addresses(page)
    labelled = {each["aria-labelledby"] for each in named if "aria-labelledby" in each}
    assert labelled <= set(ids)


def test_tables_have_captions_and_scopes(outline):
    assert len(outline.of("caption")) == len(outline.of("table"))
    assert {heading.get("scope") for heading in outline.of("th")} == {"col", "row"}


def test_nothing_is_fetched(outline):
    addresses = [
        attributes[name]
        for _, attributes in outline.elements
        for name in ("src", "href", "xlink:href", "srcset", "action")
        if name in attributes
    ]
    assert not [address for address in addresses if "//" in address]
    assert not outline.of("link", "iframe", "img")


def test_hostile_text_stays_text(page, outline):
    scripts = outline.of("script")
    assert len([each for each in scripts if "data-player" not in each]) == 2
    assert "&lt;script&gt;alert" in page
    assert "<script>alert" not in page


def test_hostile_names_stay_text(small):
    name = "<script>alert('x')</script>\"&"
    hostile = Outline(render(small({name: {name: [1.0, 2.0], "b": [float("nan")] * 2}})))
    assert len(hostile.of("script")) == 3


def test_the_headline_says_that_the_simple_model_wins(page):
    assert "<strong>gp-independent</strong> has a better mean than mohgp-1" in page


def test_the_summary_says_what_its_claims_rest_on(page, small):
    claim = "Statements about entrants compare means over {}. “More than chance” means"
    assert claim.format("5 or 12 folds") in page
    assert claim.format("1 fold") in render(small({"row": {"a": [1.0]}}))
    assert "Statements about entrants" not in render(small({"row": {"a": [float("nan")]}}))


def test_ranks_over_tasks_stand_in_the_summary(small):
    levels = {"spline": 2.0, "knn": 1.0, "nn": 3.0, "trivial": 4.0}
    values = {"one": {label: [x] for label, x in levels.items()}}
    tasks = [small(values, task=f"task {number}") for number in range(5)]
    together = replace(
        tasks[0],
        scores=pd.concat([task.scores for task in tasks]),
        records=pd.concat([task.records for task in tasks]),
        layouts=tuple(layout for task in tasks for layout in task.layouts),
    )
    text = render(together)
    assert text.index("Tasks that impute, ranks over tasks") < text.index('id="task-task-0"')
    assert "mean ranks of 4 entrants over 5 tasks" in text
    assert "ranks over tasks" not in render(tasks[0])


def test_one_of_each_is_singular(small):
    assert "1 task, 1 case, 1 entrant, up to 1 fold.\n1 job ok." in render(
        small({"row": {"a": [1.0]}})
    )


def test_a_reduced_budget_is_reported(small, page):
    text = render(small({"row": {"a": [1.0]}}, budget="max_iter=200"))
    assert (
        "Reduced budget in this profile: max_iter=200. "
        "Scores may be worse than those of a full run." in text
    )
    assert "Reduced budget" not in page


@pytest.mark.parametrize(("absent", "folded"), [(4, False), (5, True)])
def test_a_long_list_of_cases_not_run_is_folded(small, absent, folded):
    cases = tuple(CaseLayout(name, {}) for name in ("row", *map(str, range(absent))))
    text = render(small({"row": {"a": [1.0]}}, cases=cases))
    assert (f"<summary>Not in this run: {absent} cases</summary>" in text) is folded
    assert ", ".join(map(str, range(absent))) in text


def test_a_verdict_on_one_fold_is_marked_everywhere(small):
    text = render(
        small(
            {"row": {"cubic-spline": [62.98]}},
            metric="rms_per_frame",
            task="missing-frames",
            cases=(CaseLayout("row", {}, notes=RowNotes(published="35-03")),),
            published_models={"cubic-spline": "cubic-spline"},
            published_metrics={"rms_per_frame": "RMS per frame"},
        )
    )
    assert "1 within 2 %</span>" in text
    assert "(1 on one fold)" in text
    assert '<td class="reproduced">within 2 % <small>one fold</small></td>' in text


def test_each_failure_is_shown_with_its_traceback(bundle, outline, page):
    failed = (~bundle.records["status"].isin(["ok", "data-missing"])).sum()
    classes = [each.get("class") for each in outline.of("details")]
    assert classes.count("failure") == failed
    assert "leading minor is not positive definite" in page


def test_missing_data_come_with_their_command(page):
    assert "mocapbench data fetch cmu:12_02" in page


def test_provenance_command_and_acknowledgement_are_there(bundle, page):
    for value in bundle.provenance.values():
        assert value in page


def test_every_table_can_be_downloaded(outline, page):
    blob = re.search(r'<script type="application/json" id="downloads">(.*?)</script>', page, re.S)
    tables = json.loads(blob.group(1))
    buttons = {
        (each["data-table"], each["data-format"])
        for each in outline.of("button")
        if "data-table" in each
    }
    assert buttons == {(name, kind) for name, table in tables.items() for kind in table}


def test_the_page_stays_small(page):
    assert len(page.encode()) < 1_500_000


def test_a_run_without_any_score_still_has_a_page(bundle):
    records = bundle.records.assign(status="data-missing", message="fetch them")
    text = render(replace(bundle, records=records, scores=bundle.scores.head(0)))
    assert "No entrant has a score." in text
    assert "fetch them" in text


def test_an_empty_run_still_has_a_page(bundle):
    empty = replace(bundle, records=bundle.records.head(0), scores=bundle.scores.head(0))
    assert "No job failed." in render(empty)


def test_where_nobody_competes_the_page_does_not_say_that_there_are_no_scores(small):
    text = render(small({"row": {"replay": [1.0]}}))
    assert "No entrant here is ranked." in text
    assert "No entrant has a score." not in text
