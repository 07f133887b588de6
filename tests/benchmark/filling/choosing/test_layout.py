import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.layout import EpisodeQueue
from mocapbench.benchmark.filling.gaps import Episode, Gap


def make_queue(count):
    episodes = [Episode((Gap(10 * n, 10 * n + 5, (0,)),)) for n in range(count)]
    return EpisodeQueue(episodes, np.random.default_rng(0)), episodes


@pytest.mark.parametrize("count", [1, 3, 12])
def test_each_is_copied_before_any_is_copied_again(count):
    queue, episodes = make_queue(count)
    for _ in range(3):
        seen = []
        for _ in range(count):
            seen.append(queue.peek())
            queue.pop()
        assert sorted(episode.start for episode in seen) == [one.start for one in episodes]


def test_the_first_stays_the_first_until_it_is_popped():
    queue, _ = make_queue(3)
    assert queue.peek() == queue.peek()


def test_without_episodes_nothing_is_copied():
    assert make_queue(0)[0].n_per_hold_out == 0
