"""The policy of the page in a real browser: its script runs, and no other."""

import pytest

RAN = "<script>document.title = 'another script ran'</script>"
HANDLER = "<p id=trap onclick=\"document.title = 'another script ran'\">click</p>"


@pytest.fixture
def tab(browser):
    """A tab that notes what its page complains of."""
    tab = browser.new_page()
    tab.complaints = []
    tab.on("console", lambda message: tab.complaints.append(message.text))
    tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
    yield tab
    tab.close()


@pytest.fixture
def show(tab, tmp_path):
    """Return a function that opens the text of a page."""

    def show(page):
        path = tmp_path / "page.html"
        path.write_text(page, encoding="utf-8")
        tab.goto(path.as_uri())
        return tab

    return show


def test_the_script_of_the_report_runs_and_breaks_no_rule(show, page):
    tab = show(page)
    box = tab.locator(".finder input")
    box.fill("knn")
    tab.locator("#scoreboard th button").first.click()
    assert tab.locator("#scoreboard th[aria-sort]").count() > 0
    assert tab.complaints == []


@pytest.mark.parametrize("added", [RAN, HANDLER], ids=["script", "handler"])
def test_no_other_script_runs(show, page, added):
    tab = show(page.replace("<main", f"{added}<main", 1))
    if added is HANDLER:
        tab.locator("#trap").click()
    assert tab.title() == "mocapbench report"
    assert "Content Security Policy" in " ".join(tab.complaints)
