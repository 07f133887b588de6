from collections import Counter
from itertools import islice

import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.layout import EpisodeLayout, EpisodeQueue
from mocapbench.benchmark.filling.gaps import Episode, Gap


def make_queue(*counts):
    """Return a queue of groups of so many episodes, and the groups."""
    starts = iter(range(0, 10 * sum(counts), 10))
    groups = [[Episode((Gap(n, n + 5, (0,)),)) for n in islice(starts, count)] for count in counts]
    return EpisodeQueue(groups, np.random.default_rng(0)), groups


def take(queue, count):
    """Return the start of each of the next episodes."""
    starts = []
    for _ in range(count):
        starts.append(queue.peek().start)
        queue.pop()
    return starts


@pytest.mark.parametrize("count", [1, 3, 12])
def test_each_is_copied_before_any_is_copied_again(count):
    queue, (group,) = make_queue(count)
    for _ in range(3):
        assert sorted(take(queue, count)) == [episode.start for episode in group]


@pytest.mark.parametrize("counts", [(1, 5), (4, 1, 2)])
def test_each_group_gets_equally_many_copies_and_within_it_each_episode(counts):
    queue, groups = make_queue(*counts)
    seen = Counter(take(queue, 20 * len(counts)))
    for group in groups:
        copies = [seen[episode.start] for episode in group]
        assert sum(copies) == 20
        assert max(copies) - min(copies) <= 1


def test_the_first_stays_the_first_until_it_is_popped():
    queue, _ = make_queue(3)
    assert queue.peek() == queue.peek()


def test_without_episodes_nothing_is_copied():
    assert not make_queue()[0]
    assert make_queue(1)[0]


@pytest.mark.parametrize(("stop", "begins"), [(10, True), (11, False)])
def test_the_gap_that_a_hold_out_begins_with_lies_within_the_first_third_to_its_end(stop, begins):
    """Of thirty frames, three before ``stop`` alone are visible, with one on each side."""
    hidden = np.ones((30, 1), dtype=bool)
    hidden[stop - 4 : stop + 1] = False
    layout = EpisodeLayout(hidden, np.zeros(30, dtype=bool), np.random.default_rng(0))
    layout.begin([Gap(0, 3, (0,))])
    assert ((stop - 3, stop) in {(copy.start, copy.stop) for copy, _ in layout.copies}) is begins
