import numpy as np
import pytest

from mocapbench.baselines.kriging import marker_gap
from mocapbench.baselines.kriging.marker_gap import MarkerGap


@pytest.mark.parametrize(
    ("frames", "seconds"), [((40, 50), 2.2), ((1, 11), 2.2), ((0, 10), 2.0), ((90, 100), 2.0)]
)
def test_it_learns_from_gaps_twice_as_long_as_the_time_between_the_frames_beside_it(
    monkeypatch, frames, seconds
):
    learnt, learn = [], marker_gap.learn_marker_process

    def watch(frames, values, seconds):
        learnt.append(seconds)
        return learn(frames, values, seconds)

    monkeypatch.setattr(marker_gap, "learn_marker_process", watch)
    rng = np.random.default_rng(0)
    places = rng.normal(size=(1, 5, 3)) + 0.1 * rng.normal(size=(100, 5, 3))
    places[slice(*frames), 0] = np.nan
    gap = MarkerGap(
        [np.arange(100) / 10.0],
        [places],
        marker=0,
        frames=np.arange(*frames),
        others=np.arange(1, 5),
        steady=np.ones(4),
        power=1.0,
    )
    gap.fill()
    assert learnt == [pytest.approx(seconds)]


def test_all_frames_near_a_gap_count_however_long_the_recording_is(monkeypatch):
    seen, predict = [], marker_gap.predict_marker

    def watch(frames, *others):
        seen.append(frames.times)
        return predict(frames, *others)

    monkeypatch.setattr(marker_gap, "predict_marker", watch)
    places = np.random.default_rng(0).normal(size=(2000, 4, 3))
    places[900:940, 0] = np.nan
    gap = MarkerGap(
        [np.arange(2000.0)],
        [places],
        marker=0,
        frames=np.arange(900, 940),
        others=np.arange(1, 4),
        steady=np.ones(3),
        power=1.0,
    )
    gap.fill()
    (times,) = seen
    assert {*range(880, 900), *range(940, 960)} < set(times)
    assert len(set(times)) == len(times) < 500


@pytest.mark.parametrize(("n_others", "n_seen"), [(2, 9), (3, 0), (3, 1), (3, 2), (4, 2)])
def test_three_others_and_two_frames_that_show_the_marker_beside_them_fill_a_gap(n_others, n_seen):
    places = np.random.default_rng(0).normal(size=(10, 1 + n_others, 3))
    places[n_seen:, 0] = np.nan
    gap = MarkerGap(
        [np.arange(10) / 10.0],
        [places],
        marker=0,
        frames=np.arange(n_seen, 10),
        others=np.arange(1, 1 + n_others),
        steady=np.ones(n_others),
        power=1.0,
    )
    assert gap.can_be_filled is (n_others >= 3 and n_seen >= 2)


@pytest.mark.parametrize("unseen", [[], [49, 90], [*range(0, 300, 7)]])
@pytest.mark.parametrize(
    ("first", "rate"), [(0, 30.0), (50, 30.0), (260, 30.0), (50, 120.0), (50, 6.0)]
)
def test_how_the_shape_changes_tells_what_the_shape_alone_does_not(unseen, first, rate):
    """Bending and stretching pass through the same shapes, with the marker on other sides."""
    times = np.arange(300) / rate
    phase = 1.0 + 6.0 * times + 0.3 * np.sin(times)
    places = np.random.default_rng(0).normal(size=(1, 6, 3)).repeat(300, axis=0)
    places[:, 1, 0] += 0.3 * np.cos(phase)
    places[:, 0, 1] += 0.3 * np.sin(phase)
    gap = np.arange(first, first + 40)
    hidden = places[gap, 0]
    shown = places.copy()
    shown[unseen, 1] = np.nan
    shown[gap] = places[gap]
    shown[gap, 0] = np.nan
    steady = np.ones(5)
    filled, _ = MarkerGap([times], [shown], 0, gap, np.arange(1, 6), steady, power=1.0).fill()
    # By the shape alone the marker would be half way, up to 0.3 from where it is.
    np.testing.assert_allclose(filled, hidden, atol=0.1)
