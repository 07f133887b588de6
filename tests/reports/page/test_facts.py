"""What is known of a model or metric stands once on the page, however many names point to it."""

import re
from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from mocapbench.reports import render
from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.page.facts import facts
from mocapbench.reports.page.notes import shared_notes

SAMPLE = "Recordings vary around a common trend, as the children of a parent do."
SPLINE = "Interpolate each channel with a smooth curve through its visible frames."
ERROR = "Mean squared difference of prediction and truth at the entries that are hidden."
SHARED = "The thesis does not disclose how many components the models of these tests had."
LONGEST = 8
TEXTS = ("li", "p", "dd", "small", "caption", "figcaption", "h4")


@pytest.fixture(scope="module")
def told(bundle):
    """Return a bundle whose models and metrics say what they are, and whose tasks share remarks."""
    metrics = dict(bundle.metrics)
    metrics["mse"] = replace(metrics["mse"], sentence=ERROR, unit="cm²", range="0 to ∞")
    return replace(bundle, layouts=tuple(map(_told, bundle.layouts)), metrics=metrics)


def _told(layout):
    toy = layout.name.startswith("toy")
    models = {
        "mohgp-1": ModelInfo("mohgp", SAMPLE, "Gil López 2017", parameters="n_components=1"),
        "mohgp-3": ModelInfo("mohgp", SAMPLE, parameters="n_components=3"),
        "moa-3": ModelInfo("moa", parameters="n_restarts=5" if toy else "n_restarts=1"),
        "cubic-spline": ModelInfo("cubic-spline", SPLINE, family="Interpolation"),
    }
    page = replace(layout.page, remarks=(*layout.page.remarks, SHARED))
    return replace(layout, models=models, page=page)


def test_labels_of_one_model_share_its_fact(told):
    found = facts(told)
    assert found["model_ids"] == {
        **{"mohgp-1": "model-mohgp", "mohgp-3": "model-mohgp"},
        "cubic-spline": "model-cubic-spline",
    }
    assert found["metric_ids"] == {"mse": "metric-mse"}
    (_, _, of_family), (_, _, of_spline) = found["models"]
    assert of_family == {"mohgp-3": "n_components=3", "mohgp-1": "n_components=1"}
    assert of_spline == {}


def test_parameters_that_differ_between_tasks_name_their_tasks(told):
    known = ModelInfo("moa", SPLINE, parameters="n_restarts=5")
    toy, walking, frames = (
        replace(layout, models={"moa-3": replace(known, parameters=parameters)})
        for layout, parameters in zip(told.layouts, ("n=5", "n=1", ""), strict=True)
    )
    again = replace(walking, name="again", page=replace(walking.page, title="Again"))
    found = facts(replace(told, layouts=(toy, walking, again, frames)))
    ((_, _, of_moa),) = found["models"]
    assert of_moa == {"moa-3": f"n=1; n=5 in {toy.page.title}"}


def test_every_name_leads_to_a_fact_that_stands_once(told):
    page = render(told)
    targets = re.findall(r'popovertarget="([^"]*)"', page)
    ids = re.findall(r'popover\b[^>]*\bid="([^"]*)"', page)
    assert set(targets) <= set(ids)
    assert len(ids) == len(set(ids)) == 3
    assert len(targets) > len(set(targets)) > 1
    assert all(page.count(sentence) == 1 for sentence in (SAMPLE, SPLINE, ERROR))


def test_a_name_of_which_nothing_is_known_opens_nothing(bundle):
    assert "popovertarget" not in render(bundle)


def test_a_remark_of_several_tasks_names_them_and_stands_once(told):
    assert render(told).count(SHARED) == 1
    (notes,) = shared_notes(told.layouts)
    assert notes["tasks"] == tuple(layout.page.title for layout in told.layouts)
    assert notes["remarks"] == [SHARED]


class _Texts(HTMLParser):
    """Collects the text of every element that holds a note."""

    def __init__(self):
        super().__init__()
        self.open, self.texts = [], []

    def handle_starttag(self, tag, attrs):
        if tag in TEXTS:
            self.open.append([tag, ""])

    def handle_data(self, data):
        for element in self.open:
            element[1] += data

    def handle_endtag(self, tag):
        if self.open and self.open[-1][0] == tag:
            self.texts.append(" ".join(self.open.pop()[1].split()))


def test_no_note_stands_twice(told):
    parser = _Texts()
    parser.feed(render(told))
    counts = Counter(text for text in parser.texts if len(text.split()) > LONGEST)
    assert counts
    assert [text for text, count in counts.items() if count > 1] == []


def test_the_rules_stand_once_and_are_short(told):
    page = render(told)
    start = page.index('<h2 id="how-to-read">')
    words = re.sub(r"<[^>]*>", " ", page[start : page.index("</section>", start)]).split()
    assert len(words) <= 300
    assert page.count("Holm") == 1
