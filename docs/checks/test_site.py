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
LEAST_WORDS = 8  # the page of a constant: its name twice, and a sentence
NOT_PROSE = ("pre", "code", "script", "style")


class Page(HTMLParser):
    """What a page links to, loads and says in its article, code aside."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.prose = [], [], {""}, ""
        self.open = dict.fromkeys(("article", *NOT_PROSE), 0)
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors |= {found.get("id"), found.get("name")}
        if tag in self.open:
            self.open[tag] += 1
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        elif tag == "link" and found.get("rel") in ("stylesheet", "icon", "preload"):
            self.loaded.append(found["href"])
        elif "src" in found:
            self.loaded.append(found["src"])

    def handle_endtag(self, tag):
        if tag in self.open:
            self.open[tag] -= 1

    def handle_data(self, data):
        if self.open["article"] and not any(self.open[tag] for tag in NOT_PROSE):
            self.prose += data


@cache
def page(name):
    return Page((SITE / name).read_text(encoding="utf-8"))


def leads_somewhere(name, link):
    """Return whether a link of a page within the site leads to a file, and to a place in it."""
    path, fragment = urldefrag(link)
    target = (SITE / name).parent.joinpath(unquote(urlsplit(path).path)) if path else SITE / name
    found = target.resolve()
    if not found.is_file() or not fragment or found.suffix != ".html":
        return found.is_file()
    return unquote(fragment) in page(found.relative_to(SITE).as_posix()).anchors


def test_the_site_was_built():
    assert {"index.html", "search.html", "genindex.html"} <= set(PAGES)


def test_every_link_within_the_site_leads_somewhere():
    for name in PAGES:
        found = page(name)
        within = [x for x in found.links + found.loaded if not re.match(r"[a-z]+:|//", x)]
        assert within
        assert not [link for link in within if not leads_somewhere(name, link)], name


def test_nothing_is_loaded_from_elsewhere():
    for name in PAGES:
        assert not [url for url in page(name).loaded if urlsplit(url).netloc], name
    for sheet in SITE.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        assert not re.search(r"(@import|url\()[\s\"']*(https?:)?//", text), sheet


def test_every_formula_is_read_as_one():
    for name in PAGES:
        assert "$" not in page(name).prose, name


def test_no_page_is_empty():
    pages = set(PAGES) - {"genindex.html", "search.html", "py-modindex.html"}
    assert not [name for name in pages if len(page(name).prose.split()) < LEAST_WORDS]


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_task_model_and_metric_has_a_page(kind):
    expected = {f"generated/{kind}/{name}.html" for name in REGISTRIES[kind].names()}
    assert expected <= set(PAGES)


@pytest.mark.parametrize("package", front_doors.offered())
def test_every_public_name_is_described(package):
    links = page(f"api/{package.rpartition('.')[2]}.html").links
    for name in front_doors.offered()[package]:
        assert any(link.endswith(f"#{package}.{name}") for link in links), name
