"""The page in a real browser, with the network cut off."""

import time
from pathlib import Path

import pytest

CHROMIUM = Path("/usr/bin/chromium")


@pytest.fixture(scope="module")
def address(page, tmp_path_factory):
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(page, encoding="utf-8")
    return path.as_uri()


@pytest.fixture(scope="module")
def browser():
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not CHROMIUM.exists():
        pytest.skip(f"no browser at {CHROMIUM}")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=str(CHROMIUM), args=["--no-sandbox"], timeout=60_000
        )
        yield browser
        browser.close()


@pytest.fixture
def visit(browser, address):
    """Return a function that opens the page and notes complaints and requests."""
    contexts = []

    def open_page(width=1280, scheme="light", fragment="", **options):
        context = browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme, **options
        )
        contexts.append(context)
        tab = context.new_page()
        tab.complaints = []
        tab.on("console", lambda message: tab.complaints.append(message.text))
        tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
        tab.route("**/*", lambda route: _only(address, route, tab.complaints))
        tab.goto(address + fragment)
        return tab

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture
def until():
    """Return a function that waits until a condition holds in a tab.

    The tab's own ``wait_for_function`` evaluates text in the page while it polls,
    which the page's policy forbids.
    """

    def wait(tab, condition, arg=None):
        deadline = time.monotonic() + 30
        while not tab.evaluate(condition, arg):
            assert time.monotonic() < deadline, f"never came true: {condition}"
            tab.wait_for_timeout(20)

    return wait


def _only(address, route, complaints):
    if route.request.url.partition("#")[0] == address:
        route.continue_()
    else:
        complaints.append(f"asked for {route.request.url}")
        route.abort()
