"""The built site: its links lead somewhere, it needs no network, and no page is missing."""

import re
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit

import front_doors
import pytest

from mocapbench.benchmark.registry import METRICS, MODELS, TASKS

SITE = Path(__file__).parents[1] / "_build" / "html"
FILES = (path.relative_to(SITE) for path in SITE.rglob("*.html"))
PAGES = sorted(path.as_posix() for path in FILES if path.parts[0] != "_static")
REGISTRIES = {"tasks": TASKS, "models": MODELS, "metrics": METRICS}
WITHOUT_TEXT = {"genindex.html", "search.html", "py-modindex.html"}
LEAST_WORDS = 12


class Page(HTMLParser):
    """What a page links to, loads and says."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.words = [], [], {""}, 0
        self.in_article = 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors |= {found.get("id"), found.get("name")}
        self.in_article += tag == "article"
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        elif tag == "link" and found.get("rel") in ("stylesheet", "icon", "preload"):
            self.loaded.append(found["href"])
        elif tag != "a" and "src" in found:
            self.loaded.append(found["src"])

    def handle_endtag(self, tag):
        self.in_article -= tag == "article"

    def handle_data(self, data):
        self.words += len(data.split()) if self.in_article else 0


@cache
def page(name):
    return Page((SITE / name).read_text(encoding="utf-8"))


def test_the_site_was_built():
    assert "index.html" in PAGES


@pytest.mark.parametrize("name", PAGES)
def test_every_link_within_the_site_leads_to_a_page_and_to_a_place_on_it(name):
    for link in page(name).links + page(name).loaded:
        path, fragment = urldefrag(link)
        if urlsplit(link).scheme or link.startswith("//"):
            continue
        target = (SITE / name).parent.joinpath(unquote(urlsplit(path).path)).resolve()
        target = target if path else SITE / name
        assert target.is_file(), link
        if fragment and target.suffix == ".html":
            assert unquote(fragment) in page(target.relative_to(SITE).as_posix()).anchors, link


@pytest.mark.parametrize("name", PAGES)
def test_nothing_is_loaded_from_elsewhere(name):
    assert not [url for url in page(name).loaded if urlsplit(url).netloc]


def test_no_style_sheet_loads_from_elsewhere():
    for sheet in SITE.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        assert not re.search(r"(@import|url\()[\s\"']*(https?:)?//", text), sheet


@pytest.mark.parametrize("name", sorted(set(PAGES) - WITHOUT_TEXT))
def test_no_page_is_empty(name):
    assert page(name).words >= LEAST_WORDS


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_task_model_and_metric_has_a_page(kind):
    expected = {f"generated/{kind}/{name}.html" for name in REGISTRIES[kind].names()}
    assert expected <= set(PAGES)


@pytest.mark.parametrize("package", front_doors.PACKAGES)
def test_every_public_name_is_described(package):
    links = page(f"api/{package}.html").links
    for name in front_doors.offered()[f"mocapbench.{package}"]:
        assert any(link.endswith(f"#mocapbench.{package}.{name}") for link in links), name
