"""Which frames and entrants a player shows, and where it puts bodies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.benchmark import JointAngles, Solved
from mocapbench.benchmark.figures.motions.placing import on_the_spot, place_joints
from mocapbench.benchmark.figures.motions.played import LONGEST, choose_entrants, shown_frames
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.datasets import GaitLibrary, Recording, hlm_features

JOINTS = ("root", "lfemur", "rfemur", "head")


@given(
    rate=st.integers(10, 500), n=st.integers(2, 3000), start=st.floats(0, 1), length=st.floats(0, 1)
)
def test_the_window_is_short_even_and_has_the_gap(rate, n, start, length):
    times, hidden = np.arange(n) / rate, np.zeros(n, dtype=bool)
    first = int(start * (n - 1))
    hidden[first : first + 1 + int(length * n)] = True
    still = Recording("still", times, np.where(hidden, np.nan, 0.0)[:, None], ("hip",), ("deg",))
    rows = shown_frames(still)
    shown = times[rows]
    assert shown[-1] - shown[0] <= LONGEST + 1e-9
    assert len(set(np.diff(rows))) <= 1
    assert len(rows) < 2 or 1 / np.diff(shown).mean() < 60 or rate < 60
    assert (np.abs(rows - first) <= rate / 30 + 1).any()
    assert (
        len(rows) == len(np.arange(0, n, max(rate // 30, 1)))
        or shown[-1] - shown[0] > LONGEST - 0.5
    )


def solved(ranking, solutions, interpolations=()):
    return Solved("task", None, dict.fromkeys(solutions), {}, (), ranking, "MSE", interpolations)


def test_the_best_are_shown_and_the_best_interpolation():
    labels, beside, phrase = choose_entrants(solved("abcde", "edcba", ("d", "e")), 2)
    assert labels == ("a", "b", "d")
    assert beside == "d"
    assert phrase == "The first 2 of 5 entrants and the best interpolation, best first by MSE here"


def test_all_are_shown_if_there_are_few():
    labels, beside, phrase = choose_entrants(solved("ab", "zba", ("a",)), 8)
    assert labels == ("a", "b", "z")
    assert (beside, phrase) == ("b", "All 3 entrants, best first by MSE here")
    assert choose_entrants(solved((), "z"), 8)[1] == "z"


@given(st.floats(-np.pi, np.pi), st.floats(-100, 100))
def test_a_body_faces_along_x_on_the_ground_wherever_it_went(heading, height):
    # Facing along z: x is to the left.
    body = np.array([[0.0, 90, 0], [10, 50, 0], [-10, 50, 0], [0, 160, 5]])
    cosine, sine = np.cos(heading), np.sin(heading)
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    truth = (body @ turn.T + [0, height, 0])[None]
    seen, made = side_view(truth, np.add(truth, [0.0, 3.0, 0.0]), JOINTS)
    np.testing.assert_allclose(
        seen[0], [[0, 40, 0], [0, 0, -10], [0, 0, 10], [5, 110, 0]], atol=1e-9
    )
    np.testing.assert_allclose(made - seen, [[[0, 3, 0]] * 4], atol=1e-9)


def test_a_body_without_sides_is_not_turned():
    truth = np.arange(24.0).reshape(2, 4, 3)
    seen, _ = side_view(truth, truth, ("a", "b", "c", "d"))
    np.testing.assert_array_equal(seen, truth - [0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def walk():
    motion = GaitLibrary().motion("01_01")
    return JointAngles(motion.skeleton), motion.recording("walk")


@pytest.mark.parametrize("features", [hlm_features, lambda recording: recording])
def test_motions_placed_at_once_are_where_each_is_alone(walk, features):
    body, recording = walk[0], features(walk[1])
    motions = [recording.values, recording.values[::-1], 0.5 * recording.values]
    for positions, values in zip(place_joints(body, recording, motions), motions, strict=True):
        alone = body.positions(recording.with_values(values))
        np.testing.assert_allclose(positions, alone, atol=1e-9)


def test_on_the_spot_only_the_height_of_the_root_is_left(walk):
    body, recording = walk
    positions = body.positions(recording)
    spot = on_the_spot(positions)
    np.testing.assert_array_equal(spot[:, 0, [0, 2]], 0.0)
    np.testing.assert_array_equal(spot[..., 1], positions[..., 1])
