import json
import re
from base64 import b64encode
from collections import Counter
from dataclasses import replace
from hashlib import sha256
from html.parser import HTMLParser
from itertools import pairwise

import numpy as np
import pytest

from mocapbench.basics.words import printable
from mocapbench.reports import CaseLayout, render

QUICK = {"profile": "quick"}


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


def test_ids_are_unique_and_every_link_leads_somewhere(outline):
    ids = Counter(attributes["id"] for _, attributes in outline.elements if "id" in attributes)
    assert set(ids.values()) == {1}
    named = [attributes for _, attributes in outline.elements]
    targets = {link["href"] for link in outline.of("a") if "href" in link}  # scripts set others
    places = {target for target in targets if not target.startswith("#cell=")}
    assert places <= {f"#{name}" for name in ids}
    labels = [each["aria-labelledby"] for each in named if "aria-labelledby" in each]
    assert {name for label in labels for name in label.split()} <= set(ids)


def test_tables_have_captions_and_scopes(outline):
    named = [table for table in outline.of("table") if "aria-labelledby" in table]
    assert len(outline.of("caption")) + len(named) == len(outline.of("table"))
    scopes = {heading.get("scope") for heading in outline.of("th")}
    assert scopes == {"col", "row", "colgroup", "rowgroup"}


def test_nothing_is_fetched(outline):
    addresses = [
        attributes[name]
        for _, attributes in outline.elements
        for name in ("src", "href", "xlink:href", "srcset", "action")
        if name in attributes
    ]
    assert [address for address in addresses if not address.startswith("#")] == []
    assert not outline.of("link", "iframe", "img")


def test_hostile_text_stays_text(page, outline):
    scripts = outline.of("script")
    assert len([each for each in scripts if "data-player" not in each]) == 2
    assert "&lt;script&gt;alert" in page
    assert "<script>alert" not in page


def test_hostile_names_stay_text(small):
    name = "<script>alert('x')</script>\"&"
    hostile = Outline(render(small({name: {name: [1.0, 2.0], "b": [float("nan")] * 2}})))
    assert len(hostile.of("script")) == 2


def test_no_name_hides_what_it_is(small):
    name, seen = "kn\u202en\x1b]0;x\x07\u2067\0", "knn"
    values = {name: {name: [1.0, 2.0], "b": [float("nan")] * 2}}
    page = render(small(values, task=name, title=name))
    assert printable(page) == page
    ((cells,),) = [re.findall(r'id="cells">(.*)</script>', page)]
    assert [*json.loads(cells)["tasks"]] == [seen]
    assert not re.search(r"\\u(?:202e|001b|2067|0000)", cells)
    assert f"#cell={seen}/{seen}/{seen}" in page


def test_the_policy_names_the_script_of_the_page_and_no_other(page):
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    (script,) = re.findall("<script>(.*?)</script>", page, re.DOTALL)
    digest = b64encode(sha256(script.encode()).digest()).decode()
    assert policy == (
        f"default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    )


def test_the_headline_says_that_the_simple_model_wins(page):
    assert "<strong>gp-independent</strong> has a better mean than mohgp-1" in page


def test_a_reduced_budget_is_reported_with_the_task_and_on_the_first_screen(small, page):
    text = render(replace(small({"row": {"a": [1.0]}}, budget="max_iter=200"), provenance=QUICK))
    assert "reduced budget: max_iter=200" in text
    assert "profile quick, reduced budgets" in text
    assert "educed budget" not in page


def test_cases_that_did_not_run_are_counted(small):
    cases = tuple(CaseLayout(name, {}) for name in ("row", "x", "y"))
    assert "not in this run: 2 cases" in render(small({"row": {"a": [1.0]}}, cases=cases))
    assert "not in this run" not in render(small({"row": {"a": [1.0]}}))


def test_a_verdict_on_one_fold_is_marked(small):
    text = render(
        small(
            {"row": {"cubic-spline": [62.98]}},
            metric="rms_per_frame",
            task="missing-frames",
            published_rows={"row": "35-03"},
            published_models={"cubic-spline": "cubic-spline"},
            published_metrics={"rms_per_frame": "RMS per frame"},
        )
    )
    assert '<td class="reproduced">within 2 % <small>one fold</small></td>' in text


def test_each_failure_is_shown_with_its_traceback(bundle, outline, page):
    failed = (~bundle.records["status"].isin(["ok", "data-missing"])).sum()
    classes = [each.get("class") for each in outline.of("details")]
    assert classes.count("failure") == failed
    assert "leading minor is not positive definite" in page


def test_folds_of_failures_count_from_one(small):
    page = render(small({"row": {"a": [1.0, np.nan]}}))
    assert "a · small · row · fold 2</summary>" in page


def test_missing_data_come_with_their_command(page):
    assert "mocapbench data fetch cmu:12_02" in page


def test_provenance_command_and_acknowledgement_are_there(bundle, page):
    for value in bundle.provenance.values():
        assert value in page


def test_every_table_of_numbers_can_be_downloaded_in_both_formats(outline):
    tables = {table["id"] for table in outline.of("table") if "id" in table}
    buttons = [
        (each["data-table"], each["data-format"])
        for each in outline.of("button")
        if "data-table" in each
    ]
    assert len(buttons) == len(set(buttons))
    assert set(buttons) == {
        (name, kind) for name in tables - {"scoreboard"} for kind in ("csv", "tex")
    }


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
