import numpy as np

from mocapbench.baselines.k_cpm import KCPM
from mocapbench.datasets import Recording


def _walks():
    rng = np.random.default_rng(0)
    for k in range(6):
        phase = 2.0 * np.pi * (np.arange(40) / 12.0 + rng.random())
        values = 5.0 * np.sin(phase[:, None] * [1, 2] + [0.0, 1.0]) + [0.0, 6.0 * (k % 2)]
        values += 0.2 * rng.normal(size=values.shape)
        yield Recording(f"w{k}", np.arange(40) / 30, values, ("a", "b"), ("deg", "deg"))


WALKS = tuple(_walks())


def test_styles_are_told_apart_and_seeded():
    one, two = (KCPM(2, max_iter=15, random_state=1).fit(WALKS) for _ in range(2))
    assert len(set(one.labels_[::2])) == len(set(one.labels_[1::2])) == 1
    assert one.labels_[0] != one.labels_[1]
    np.testing.assert_array_equal(one.labels_, two.labels_)
    assert one.cycles_.shape == (2, one.cpm_.cycle_length_, 2)


def test_more_styles_than_recordings_give_each_its_own():
    assert sorted(KCPM(9, max_iter=3, random_state=0).fit(WALKS[:3]).labels_) == [0, 1, 2]
