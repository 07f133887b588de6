"""The motion player in a real browser, from a file."""

import re

import numpy as np
import pytest

pytestmark = pytest.mark.slow

PLAYER = ".player"
STILL_FRAMES = 60
MOVES = "drawing => { window.before = drawing.toDataURL() }"
MOVED = "drawing => drawing.toDataURL() !== window.before"


def bring_near(tab, selector):
    """Scroll until the page, which is laid out on the way, stays where it is."""
    for _ in range(8):
        tab.locator(selector).evaluate("node => node.scrollIntoView({ behavior: 'instant' })")
        tab.wait_for_timeout(100)


@pytest.fixture
def player(browser, address):
    """Return a function that opens the page at its player, which is ready and has the focus."""
    contexts = []

    def open_player(width=1280, **options):
        context = browser.new_context(viewport={"width": width, "height": 900}, **options)
        contexts.append(context)
        tab = context.new_page()
        tab.complaints = []
        tab.on("console", lambda message: tab.complaints.append(message.text))
        tab.on("pageerror", lambda error: tab.complaints.append(str(error)))
        tab.goto(address)
        bring_near(tab, ".player-figure")
        tab.wait_for_selector(f"{PLAYER}[data-ready]")
        tab.locator(PLAYER).focus()
        return tab

    yield open_player
    for context in contexts:
        assert context.pages[0].complaints == []
        context.close()


def said(tab):
    return tab.locator(f"{PLAYER} output").inner_text()


def frame(tab):
    return int(tab.locator(f"{PLAYER} input[type=range]").input_value())


def until(tab, holds):
    """Wait for a condition, which the page's policy keeps from being a script of its own."""
    for _ in range(100):
        if holds():
            return
        tab.wait_for_timeout(50)
    raise AssertionError("it never came true")


def test_it_is_decoded_only_near_the_window(browser, address):
    context = browser.new_context(viewport={"width": 1280, "height": 500})
    tab = context.new_page()
    tab.goto(address)
    tab.wait_for_timeout(300)
    assert tab.locator(PLAYER).get_attribute("data-ready") is None
    context.close()


def test_the_keyboard_plays_and_scrubs(player):
    tab = player()
    tab.keyboard.press("ArrowRight")
    tab.keyboard.press("ArrowRight")
    assert frame(tab) == 2
    tab.keyboard.press("ArrowLeft")
    assert frame(tab) == 1
    tab.keyboard.press("End")
    assert frame(tab) == STILL_FRAMES - 1
    tab.keyboard.press("Home")
    assert frame(tab) == 0
    tab.keyboard.press("Space")
    until(tab, lambda: frame(tab) > 2)
    assert tab.locator("[data-play]").inner_text() == "Pause"
    tab.keyboard.press("Space")
    stopped = frame(tab)
    tab.wait_for_timeout(150)
    assert frame(tab) == stopped


def test_it_never_starts_by_itself(player):
    tab = player()
    tab.wait_for_timeout(200)
    assert frame(tab) == 0


def test_the_errors_are_those_of_the_positions(player, bundle):
    picture = bundle.illustrations[-1]
    tab = player()
    truth = picture.truths["truth"]
    for step in (0, 25, 39):
        tab.locator("input[type=range]").fill(str(step))
        means = [
            np.linalg.norm(positions[step] - truth[step], axis=-1).mean()
            for positions in picture.motions.values()
        ]
        found = [float(cm) for cm in re.findall(r"([\d.]+) cm", said(tab))]
        assert found == pytest.approx(means, abs=0.06)  # shown with one decimal
        assert ("hidden" in said(tab)) == bool(picture.hidden[step])


def test_views_layouts_and_colours_change_the_drawing(player):
    tab = player()
    tab.locator("input[type=range]").fill("30")
    drawing = tab.locator(f"{PLAYER} canvas")
    for change in (
        lambda: tab.keyboard.press("2"),
        lambda: tab.keyboard.press("3"),
        lambda: tab.locator("[data-layout]").select_option("over"),
        lambda: tab.locator("[data-errors]").check(),
        lambda: tab.locator("[data-choice=a]").select_option(label="above"),
    ):
        tab.locator("input[type=range]").focus()
        drawing.evaluate(MOVES)
        change()
        assert drawing.evaluate(MOVED)
    assert tab.locator("[data-view]").input_value() == "free"
    assert tab.locator(".player-scale").is_visible()


@pytest.mark.parametrize("view", ["side", "free"])
def test_dragging_turns_the_free_view_alone(player, view):
    tab = player()
    tab.locator("[data-view]").select_option(view)
    drawing = tab.locator(f"{PLAYER} canvas")
    drawing.scroll_into_view_if_needed()
    drawing.evaluate(MOVES)
    box = drawing.bounding_box()
    tab.mouse.move(box["x"] + 100, box["y"] + 100)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 160, box["y"] + 110, steps=3)
    tab.mouse.up()
    assert drawing.evaluate(MOVED) == (view == "free")
    assert drawing.evaluate("canvas => getComputedStyle(canvas).touchAction") == (
        "none" if view == "free" else "pan-y"
    )


def test_less_motion_is_a_strip_until_it_is_asked_to_play(player):
    tab = player(reduced_motion="reduce")
    assert not tab.locator("[data-play]").is_visible()
    tab.locator("[data-animate]").click()
    assert tab.locator("[data-play]").is_visible()
    until(tab, lambda: frame(tab) > 1)


def test_the_colours_follow_the_theme(player):
    tab = player(color_scheme="light")
    drawing = tab.locator(f"{PLAYER} canvas")
    drawing.evaluate(MOVES)
    tab.emulate_media(color_scheme="dark")
    until(tab, lambda: drawing.evaluate(MOVED))


def test_it_prints_as_a_strip(player):
    tab = player()
    tab.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert not tab.locator("[data-play]").is_visible()
    tab.evaluate("dispatchEvent(new Event('afterprint'))")
    assert tab.locator("[data-play]").is_visible()


def test_it_fits_a_phone(player):
    tab = player(width=390, has_touch=True)
    assert tab.evaluate("document.documentElement.scrollWidth") == 390


def test_without_scripts_it_says_so(browser, address):
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    tab.goto(address)
    assert not tab.locator(PLAYER).is_visible()
    bring_near(tab, ".player-figure")
    shown = tab.locator(".player-figure").inner_text()
    assert "The motion player needs JavaScript." in shown
    context.close()
