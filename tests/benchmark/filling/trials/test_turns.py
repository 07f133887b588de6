import numpy as np
import pytest

from mocapbench.benchmark.filling.gaps import Episode, Gap
from mocapbench.benchmark.filling.trials.turns import Turns


def turns_of(count):
    episodes = [Episode((Gap(10 * n, 10 * n + 5, (0,)),)) for n in range(count)]
    return Turns(episodes, np.random.default_rng(0)), episodes


@pytest.mark.parametrize("count", [1, 3, 12])
def test_each_has_a_turn_before_any_has_a_second(count):
    turns, episodes = turns_of(count)
    for _ in range(3):
        seen = []
        for _ in range(count):
            seen.append(turns.next())
            turns.done()
        assert sorted(episode.start for episode in seen) == [one.start for one in episodes]


def test_a_turn_lasts_until_it_is_done():
    turns, _ = turns_of(3)
    assert turns.next() == turns.next()


def test_without_episodes_nobody_has_a_turn():
    assert turns_of(0)[0].per_trial == 0
