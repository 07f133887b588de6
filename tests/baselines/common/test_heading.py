"""To turn a motion about the vertical changes its heading alone."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mocapbench.baselines.common.heading import face_ahead, face_as_before
from mocapbench.benchmark.testing.facing import rotate_motion
from mocapbench.datasets import Recording, joint_positions, open_archive

N_DRAWS = 4000
DEGREES = (0.0, 37.0, 90.0, 180.0, -135.0)


@pytest.fixture(scope="module")
def walk():
    return open_archive().recording("gait:01_01").frames(np.arange(0, 200, 4))


@pytest.mark.parametrize("degrees", DEGREES)
def test_all_that_a_turn_changes_is_the_heading(walk, degrees):
    (ahead, heading), (same, other) = face_ahead(walk), face_ahead(rotate_motion(walk, degrees))
    np.testing.assert_allclose(same.values, ahead.values, atol=1e-9)
    apart = (np.degrees(other - heading) - degrees + 180.0) % 360.0 - 180.0
    assert apart == pytest.approx(0.0, abs=1e-9)


def test_a_turn_moves_joints_as_it_moves_the_body(walk):
    skeleton = open_archive().skeleton("gait:01_01")
    about = Rotation.from_euler("y", 70.0, degrees=True)
    before, after = (joint_positions(skeleton, each) for each in (walk, rotate_motion(walk, 70.0)))
    np.testing.assert_allclose(after.reshape(-1, 3), about.apply(before.reshape(-1, 3)), atol=1e-9)


@pytest.mark.parametrize("degrees", DEGREES)
def test_what_is_turned_ahead_is_turned_back_beside_what_is_visible(walk, degrees):
    whole = rotate_motion(walk, degrees)
    gap = np.repeat((np.arange(50) // 10 == 2)[:, None], len(whole.channels), axis=1)
    _, heading = face_ahead(whole.hide(gap))
    (ahead, of_all) = face_ahead(whole)
    known = ahead.values.copy()
    known[:, whole.channels.index("root.ry")] += np.degrees(of_all - heading)
    path = [whole.channels.index(name) for name in ("root.tx", "root.tz")]
    moved = Rotation.from_euler("y", of_all - heading).apply(np.insert(known[:, path], 1, 0, 1))
    known[:, path] = moved[:, [0, 2]]
    prediction = face_as_before(whole.hide(gap), known, None, heading)
    np.testing.assert_allclose(prediction.mean, whole.values, atol=1e-9)


@pytest.mark.parametrize("degrees", [0.0, 37.0, 180.0])
def test_variances_are_those_of_draws(walk, degrees):
    """Where angles are far from ±90° about the y axis, and doubt is small."""
    still, rng = rotate_motion(walk, degrees).frames([20, 21]), np.random.default_rng(0)
    pose = np.repeat(still.values[:1], N_DRAWS + 2, axis=0)
    whole = replace(still, values=pose, times=np.arange(N_DRAWS + 2.0))
    hidden = np.zeros(pose.shape, dtype=bool)
    hidden[1:-1] = True
    ahead, heading = face_ahead(whole)
    spread = np.tile(rng.uniform(0.1, 0.3, pose.shape[1]), (len(pose), 1))
    drawn = face_as_before(whole.hide(hidden), rng.normal(ahead.values, spread), None, heading)
    prediction = face_as_before(whole.hide(hidden), ahead.values, spread**2, heading)
    np.testing.assert_allclose(np.var(drawn.mean[1:-1], axis=0), prediction.variance[1], rtol=0.15)


def test_other_recordings_stay_as_they_are():
    values = np.arange(12.0).reshape(4, 3)
    names = ("root.rx", "root.ry", "root.rz")
    for channels, unit in ((("hip.rx", "hip.ry", "hip.rz"), "deg"), (names, "rad")):
        one = Recording("one", np.arange(4.0), values, channels, (unit,) * 3)
        assert face_ahead(one) == (one, 0.0)
