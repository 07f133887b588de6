import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mocapbench.baselines import MarkerKriging, RigidBody
from mocapbench.benchmark.testing.facing import load_marked_walks
from mocapbench.datasets import Recording

N_FRAMES, N_MARKERS = 240, 8
AWAY = np.array([100.0, 0.0, 0.0])


def bending(seed):
    """Return markers (N, M, 3): four on a thigh, four on a shank that bends against it.

    Marker 4, at the knee, shifts on the shank by how much the knee is bent.
    """
    rng = np.random.default_rng(seed)
    phase = np.cumsum(rng.uniform(0.03, 0.09, N_FRAMES))
    bent = Rotation.from_rotvec(np.outer(0.6 + 0.5 * np.sin(phase), [1.0, 0.0, 0.0]))
    whole = Rotation.from_rotvec(np.cumsum(rng.normal(0.0, 0.02, (N_FRAMES, 3)), axis=0))
    thigh, shank = rng.normal(0.0, 80.0, (4, 3)), rng.normal(0.0, 80.0, (4, 3)) - [0, 0, 300.0]
    parts = [np.tile(marker, (N_FRAMES, 1)) for marker in thigh]
    parts += [bent.apply(marker) for marker in shank]
    parts[4] = parts[4] + np.outer(np.sin(phase), [0.0, 15.0, 10.0])
    path = np.cumsum(rng.normal(0.0, 5.0, (N_FRAMES, 3)), axis=0)
    noise = rng.normal(0.0, 0.2, (N_FRAMES, N_MARKERS, 3))
    return np.stack([whole.apply(part) + path for part in parts], axis=1) + noise


def recording(places, name="body"):
    names = [f"m{marker}.{axis}" for marker in range(places.shape[1]) for axis in "xyz"]
    values = places.reshape(len(places), -1)
    times = np.arange(len(places)) / 100
    return Recording(name, times, values, tuple(names), ("mm",) * len(names))


def gap(first, stop, *markers):
    hidden = np.zeros((N_FRAMES, N_MARKERS, 3), dtype=bool)
    hidden[first:stop, list(markers)] = True
    return hidden.reshape(N_FRAMES, -1)


def filled(places, hidden, others=(), **parameters):
    given = recording(places).hide(hidden)
    return MarkerKriging(**parameters).fit([given, *others]).impute([given])[0]


def error(places, hidden, mean):
    return np.sqrt(np.mean((mean - recording(places).values)[hidden] ** 2))


GAPS = [gap(80, 150, 4), gap(80, 120, 4, 5), gap(0, 40, 4), gap(30, 60, 4) | gap(120, 150, 4, 1)]


@pytest.mark.parametrize("hidden", GAPS)
def test_it_learns_how_a_marker_moves_on_the_body(hidden):
    """Carried along as if it were rigid, the marker is twice as far off at least."""
    for seed in range(2):
        places = bending(seed)
        given = recording(places).hide(hidden)
        (rigid,) = RigidBody().fit([given]).impute([given])
        mean = filled(places, hidden).mean
        assert error(places, hidden, mean) < 0.5 * error(places, hidden, rigid.mean)


def test_intervals_hold_as_much_as_they_claim():
    ratios = []
    for seed in range(4):
        places = bending(seed)
        for hidden in GAPS:
            prediction = filled(places, hidden)
            errors = (prediction.mean - recording(places).values)[hidden]
            ratios.append(np.abs(errors) < 1.96 * np.sqrt(prediction.variance[hidden]))
    assert 0.88 < np.concatenate(ratios).mean() < 0.995


def test_it_does_not_depend_on_the_axes_and_the_unit():
    places, hidden, turn = bending(3), GAPS[-1], Rotation.from_rotvec([0.3, -1.0, 0.4])

    def moved(points):
        return turn.apply(points.reshape(-1, 3)).reshape(places.shape) + np.array([500, -20, 3])

    plain = filled(places, hidden)
    turned, metres = filled(moved(places), hidden), filled(places / 1000, hidden)
    expected = recording(moved(plain.mean)).values
    np.testing.assert_allclose(turned.mean, expected, atol=0.05)
    np.testing.assert_allclose(turned.variance, plain.variance, rtol=0.05)
    np.testing.assert_allclose(1000 * metres.mean, plain.mean, atol=0.05)


def test_the_order_of_markers_does_not_matter():
    places, hidden = bending(4), GAPS[-1]
    backwards = hidden.reshape(places.shape)[:, ::-1].reshape(hidden.shape)
    other = filled(places[:, ::-1], backwards).mean.reshape(places.shape)[:, ::-1]
    np.testing.assert_allclose(other, filled(places, hidden).mean.reshape(places.shape), atol=0.05)


def test_other_recordings_of_the_same_markers_tell_of_one_that_is_hardly_seen():
    places, hidden = bending(5), gap(5, 240, 4)
    other = recording(AWAY + np.flip(bending(5), axis=0), "another")
    alone, taught = (filled(places, hidden, others) for others in ((), (other,)))
    assert error(places, hidden, taught.mean) < 0.5 * error(places, hidden, alone.mean)


def test_a_marker_hidden_throughout_is_learnt_from_other_recordings():
    places, hidden = bending(6), gap(0, N_FRAMES, 4)
    other = recording(AWAY + np.flip(bending(6), axis=0), "another")
    assert error(places, hidden, filled(places, hidden, (other,)).mean) < 5.0


@pytest.mark.parametrize(
    "hidden", [gap(100, 120, *range(N_MARKERS)), gap(100, 120, *range(6)), gap(0, 9, *range(6))]
)
def test_with_fewer_than_three_others_the_course_over_time_fills(hidden):
    places = bending(7)
    prediction = filled(places, hidden)
    assert np.isfinite(prediction.mean).all()
    assert (prediction.variance[hidden] > 0.0).all()
    held = np.sqrt(np.mean(np.var(places[90:130], axis=0)))
    assert error(places, hidden, prediction.mean) < 3.0 * held


@pytest.mark.parametrize("rate", [0.0, 0.01])
def test_a_body_without_noise_is_filled_exactly(rate):
    """As one that stands still, or only travels."""
    standing = np.random.default_rng(8).normal(0.0, 100.0, (1, N_MARKERS, 3))
    places = standing + rate * np.arange(N_FRAMES)[:, None, None]
    prediction = filled(places, GAPS[1])
    np.testing.assert_allclose(prediction.mean, recording(places).values, atol=1e-3)
    assert (prediction.variance[GAPS[1]] > 0.0).all()


def test_channels_that_are_no_markers_are_filled_by_their_course():
    values = np.sin(np.arange(90.0) / 9)[:, None] * [1.0, 2.0]
    angles = Recording("angles", np.arange(90.0) / 30, values, ("a", "b"), ("deg", "deg"))
    hidden = (np.arange(90) > 40)[:, None] & (np.arange(90) < 46)[:, None] & np.array([True, False])
    given = angles.hide(hidden)
    (prediction,) = MarkerKriging().fit([given]).impute([given])
    assert np.abs(prediction.mean - values).max() < 0.05
    assert (prediction.variance[hidden] > 0.0).all()


@pytest.mark.parametrize("power", [0.0, -1.0, np.inf])
def test_a_power_that_is_not_positive_is_refused(power):
    with pytest.raises(ValueError, match="power"):
        MarkerKriging(power=power).fit([recording(bending(0))])


def test_a_channel_that_is_visible_once_is_refused():
    given = recording(bending(0)).hide(gap(0, N_FRAMES - 1, 2))
    with pytest.raises(ValueError, match="at least two visible entries"):
        MarkerKriging().fit([given]).impute([given])


@pytest.mark.parametrize("off", [0.0, 0.2, 2.0])
def test_others_on_a_line_do_not_swing_the_marker_around_it(off):
    body = np.array([[60.0, 0, 120], [0, 0, 0], [off, 0, 150], [0, 0, 300]])
    rng = np.random.default_rng(2)
    path = np.cumsum(rng.normal(0.0, 5.0, (N_FRAMES, 1, 3)), axis=0)
    places = body + path + rng.normal(0.0, 0.5, (N_FRAMES, 4, 3))
    hidden = np.zeros((N_FRAMES, 4, 3), dtype=bool)
    hidden[80:150, 0] = True
    hidden = hidden.reshape(N_FRAMES, -1)
    prediction = filled(places, hidden)
    errors = np.abs(prediction.mean - recording(places).values)[hidden]
    assert errors.max() < 5.0
    assert (errors < 1.96 * np.sqrt(prediction.variance[hidden])).mean() > 0.8


def test_neither_names_nor_order_of_training_change_a_fill():
    """Of the others, 720 frames in all, about 400 count."""
    others = [bending(seed) for seed in (5, 6, 7)]
    means = []
    for order in ([0, 1, 2], [2, 0, 1]):
        named = [recording(others[place], f"other {n}") for n, place in enumerate(order)]
        means.append(filled(bending(0), GAPS[0], named).mean)
    np.testing.assert_array_equal(means[1], means[0])


@pytest.mark.parametrize("joint", ["lhipjoint.", "rhipjoint.", "ltibia.", "rtibia."])
def test_joints_that_never_move_apart_tell_no_less_than_ones_that_do(joint):
    """Those next to a hidden one keep their distance exactly, and others tell where it turns."""

    def error(noise):
        rng = np.random.default_rng(0)
        walks = [
            walk.with_values(walk.values + noise * rng.normal(size=walk.values.shape))
            for walk in load_marked_walks()
        ]
        truth, hidden = walks[-1].values, np.zeros(walks[-1].values.shape, dtype=bool)
        hidden[15:30] = [name.startswith(joint) for name in walks[-1].channels]
        model = MarkerKriging().fit(walks[:-1])
        (filled,) = model.impute([walks[-1].hide(hidden)])
        return np.sqrt(np.mean((filled.mean - truth)[hidden] ** 2))

    assert error(0.0) < 0.5 * error(0.05)  # half a millimetre
