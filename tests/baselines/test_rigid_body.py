import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mocapbench.baselines import PchipImputer, RigidBody
from mocapbench.datasets import Recording

seeds = st.integers(0, 2**16)
N_FRAMES, N_MARKERS = 40, 6


def recording(places):
    """Return markers (N, M, 3) as a recording."""
    names = [f"m{marker}.{axis}" for marker in range(places.shape[1]) for axis in "xyz"]
    values = places.reshape(len(places), -1)
    times = np.arange(len(places)) / 100
    return Recording("body", times, values, tuple(names), ("mm",) * len(names))


def tumbling(seed):
    """Return six markers of one rigid body that turns and travels (N, M, 3)."""
    rng = np.random.default_rng(seed)
    body = rng.normal(0.0, 100.0, (N_MARKERS, 3))
    turns = Rotation.from_rotvec(np.cumsum(rng.normal(0.0, 0.1, (N_FRAMES, 3)), axis=0))
    path = np.cumsum(rng.normal(0.0, 20.0, (N_FRAMES, 1, 3)), axis=0)
    return np.stack([turns.apply(marker) for marker in body], axis=1) + path


def loose(seed):
    """Return markers that move against each other, too."""
    noise = np.random.default_rng([seed, 1]).normal(0.0, 1.0, (N_FRAMES, N_MARKERS, 3))
    return tumbling(seed) + np.cumsum(noise * np.arange(1, N_MARKERS + 1)[:, None], axis=0)


def gap(first, stop, *markers):
    hidden = np.zeros((N_FRAMES, N_MARKERS, 3), dtype=bool)
    hidden[first:stop, list(markers)] = True
    return hidden.reshape(N_FRAMES, -1)


def filled(places, hidden, **parameters):
    given = recording(places).hide(hidden)
    return RigidBody(**parameters).fit([given]).impute([given])[0].mean


GAPS = [gap(10, 30, 0), gap(0, 15, 2), gap(25, 40, 5), gap(5, 12, 0, 3) | gap(20, 39, 1)]


@pytest.mark.parametrize("hidden", GAPS)
@given(seed=seeds)
def test_markers_of_a_rigid_body_are_where_it_takes_them(hidden, seed):
    places = tumbling(seed)
    np.testing.assert_allclose(filled(places, hidden), recording(places).values, atol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("hidden", GAPS)
@given(seed=seeds)
def test_it_does_not_depend_on_the_axes_and_the_unit(hidden, seed):
    places, turn = loose(seed), Rotation.from_rotvec([0.3, -1.0, 0.01 * (seed % 100)])

    def moved(points):
        return turn.apply(points.reshape(-1, 3)).reshape(places.shape) + np.array([500, -20, 3])

    expected = recording(moved(filled(places, hidden))).values
    np.testing.assert_allclose(filled(moved(places), hidden), expected, atol=1e-6)
    np.testing.assert_allclose(1000 * filled(places / 1000, hidden), filled(places, hidden))


@given(seed=seeds)
def test_the_order_of_markers_does_not_matter(seed):
    places, hidden = loose(seed), GAPS[-1]
    backwards = hidden.reshape(places.shape)[:, ::-1].reshape(hidden.shape)
    other = filled(places[:, ::-1], backwards).reshape(places.shape)[:, ::-1]
    np.testing.assert_allclose(other, filled(places, hidden).reshape(places.shape), atol=1e-6)


def test_steady_neighbours_count_more_the_higher_the_power():
    """Markers 0 to 3 are one body, 4 and 5 are not of it."""
    places = tumbling(0)
    places[:, 4:] = loose(1)[:, 4:]
    errors = [
        np.abs(filled(places, gap(10, 30, 0), power=power) - recording(places).values).max()
        for power in (0.5, 1.0, 2.0)
    ]
    assert errors[0] > errors[1] > errors[2]


@pytest.mark.parametrize(
    "hidden", [gap(10, 20, *range(N_MARKERS)), gap(10, 20, 0, 1, 2, 3), gap(10, 20, 0, 1, 2, 3, 4)]
)
def test_with_fewer_than_three_others_each_channel_is_interpolated(hidden):
    given_ = recording(loose(0)).hide(hidden)
    (curve,) = PchipImputer().fit([given_]).impute([given_])
    np.testing.assert_array_equal(filled(loose(0), hidden), curve.mean)


def test_a_marker_that_is_never_seen_beside_the_others_is_where_it_was_in_training():
    learnt = recording(tumbling(1))
    given = recording(tumbling(2)).hide(gap(0, N_FRAMES, 4))
    (found,) = RigidBody().fit([learnt]).impute([given])
    (curve,) = PchipImputer().fit([learnt]).impute([given])
    np.testing.assert_array_equal(found.mean, curve.mean)


def test_channels_that_are_no_markers_are_interpolated():
    values = np.sin(np.arange(27.0)).reshape(9, 3)
    angles = Recording("angles", np.arange(9.0), values, ("a", "b", "c"), ("deg",) * 3)
    given_ = angles.hide(np.arange(27).reshape(9, 3) % 9 == 4)
    (curve,) = PchipImputer().fit([given_]).impute([given_])
    (prediction,) = RigidBody().fit([given_]).impute([given_])
    np.testing.assert_array_equal(prediction.mean, curve.mean)
    assert prediction.variance is None


@pytest.mark.parametrize("power", [0.0, -1.0, np.inf])
def test_a_power_that_is_not_positive_is_refused(power):
    with pytest.raises(ValueError, match="power"):
        RigidBody(power=power).fit([recording(loose(0))])


@pytest.mark.parametrize("off", [0.0, 0.2, 2.0])
@pytest.mark.parametrize("noise", [0.0, 0.5])
def test_others_on_a_line_do_not_swing_the_marker_around_it(off, noise):
    """They cannot tell how it turns about the line: it is carried as if it did not turn."""
    body = np.array([[60.0, 0, 120], [0, 0, 0], [off, 0, 150], [0, 0, 300]])
    path = np.cumsum(np.random.default_rng(2).normal(0.0, 20.0, (N_FRAMES, 1, 3)), axis=0)
    places = body + path + noise * np.random.default_rng(3).normal(size=(N_FRAMES, 4, 3))
    hidden = np.zeros((N_FRAMES, 4, 3), dtype=bool)
    hidden[10:30, 0] = True
    mean = filled(places, hidden.reshape(N_FRAMES, -1))
    assert np.abs(mean - recording(places).values).max() < 10.0 * noise + 1e-6
