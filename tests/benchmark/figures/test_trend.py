from functools import partial

import numpy as np
import pytest

from mocapbench.benchmark import Solved, draw_trends

FIGURE = partial(draw_trends, channels=("output-1",))


@pytest.fixture(scope="module")
def toy(posed):
    return posed("toy-interpolation-3", "test 4")


@pytest.fixture(scope="module")
def internals(toy):
    rng = np.random.default_rng(0)
    mean, variance = rng.random((2, *toy.parent.values.shape))
    times = toy.parent.times
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}


def test_the_trend_is_shown_beside_the_true_parent_with_its_band(toy, internals):
    solved = Solved("toy", toy, {}, {"mohgp-1": internals, "trivial": {}})
    (figure,) = FIGURE(solved)
    (panel,) = figure.axes
    true, inferred = panel.curves
    np.testing.assert_array_equal(true.y, toy.parent.values[:, 0])
    np.testing.assert_array_equal(inferred.y, internals["trend-mean"][:, 0])
    _, low, high = panel.bands["inferred trend"].T
    half = 1.96 * np.sqrt(internals["trend-variance"][:, 0])
    np.testing.assert_allclose(high - inferred.y, half)
    np.testing.assert_allclose(inferred.y - low, half)


def test_each_channel_and_each_entrant_has_a_panel(toy, internals):
    channels = ("output-1", "output-3")
    solved = Solved("toy", toy, {}, {"one": internals, "two": internals})
    (illustration,) = draw_trends(solved, channels)
    expected = [f"{label}, {c}" for c in channels for label in ("one", "two")]
    assert [panel.title for panel in illustration.axes] == expected
    last = illustration.axes[-1]
    np.testing.assert_array_equal(last.curves[0].y, toy.parent.values[:, 2])
    np.testing.assert_array_equal(last.curves[1].y, internals["trend-mean"][:, 2])


def test_there_is_no_picture_without_a_known_parent_or_without_a_trend(posed, toy, internals):
    walking = posed("walking-interpolation", "synthetic observed 40")
    assert FIGURE(Solved("walking", walking, {}, {"mohgp-3": internals})) == ()
    assert FIGURE(Solved("toy", toy, {}, {"trivial": {}})) == ()
