from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.arrangement import arrange, arrange_entries, restore_entries
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.datasets import Recording

UNITS = {"A.x": "mm", "A.y": "mm", "A.z": "mm", "hip.rx": "deg", "z": "", "a": "m"}


def record(values, name="r"):
    times = np.arange(len(values)) / 64
    return Recording(name, times, values, tuple(UNITS), tuple(UNITS.values()))


def make_problem(seed, order=range(6), trained=range(3), names="abc"):
    """Return a problem; the same one, but for the order of its channels and files, and names."""
    rng = np.random.default_rng(seed)
    target = rng.random((9, 6)) < 0.3
    given, *train = (record(rng.normal(size=(9, 6)), name) for name in (names[0], *names))
    channels = [given.channels[channel] for channel in order]
    return GapProblem(
        given.hide(target).select(channels),
        target[:, [*order]],
        tuple(train[n].select(channels) for n in trained),
    )


ORDERS = st.permutations(range(6))


@given(st.integers(0, 99), ORDERS)
def test_entries_are_restored_to_where_they_were(seed, channels):
    problem = make_problem(seed, channels)
    arranged, order = arrange(problem)
    entries = np.arange(problem.target.sum())
    there = arrange_entries(entries, arranged, order)
    np.testing.assert_array_equal(restore_entries(there, arranged, order), entries)


@given(st.integers(0, 99), ORDERS)
def test_arranged_entries_are_those_of_the_same_frames_and_channels(seed, channels):
    problem = make_problem(seed, channels)
    arranged, order = arrange(problem)
    frames, columns = np.nonzero(problem.target)
    names = np.char.add(np.array(problem.given.channels)[columns], frames.astype(str))
    frames, columns = np.nonzero(arranged.target)
    expected = np.char.add(np.array(arranged.given.channels)[columns], frames.astype(str))
    np.testing.assert_array_equal(arrange_entries(names, arranged, order), expected)


@settings(deadline=None)
@given(
    st.integers(0, 99),
    ORDERS,
    st.permutations(range(3)),
    st.lists(st.text(min_size=1, max_size=9), min_size=3, max_size=3, unique=True),
)
def test_one_problem_has_one_arrangement(seed, channels, trained, names):
    one, other = (
        arrange(problem)[0]
        for problem in (make_problem(seed), make_problem(seed, channels, trained, names))
    )
    np.testing.assert_array_equal(one.target, other.target)
    for first, second in zip((one.given, *one.train), (other.given, *other.train), strict=True):
        assert (first.name, first.channels, first.units) == (
            second.name,
            second.channels,
            second.units,
        )
        np.testing.assert_array_equal(first.values, second.values)
        np.testing.assert_array_equal(first.times, second.times)


@pytest.mark.parametrize("seed", range(8))
def test_when_a_recording_to_learn_from_began_does_not_matter(seed):
    problem = make_problem(seed)
    later = tuple(
        replace(one, times=one.times + 128.0 * n) for n, one in enumerate(problem.train[::-1])
    )
    arranged = [arrange(one)[0] for one in (problem, replace(problem, train=later))]
    for first, second in zip(*(one.train for one in arranged), strict=True):
        np.testing.assert_array_equal(first.values, second.values)
