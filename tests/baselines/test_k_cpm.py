import numpy as np
from samples import walks_of_two_styles

from mocapbench.baselines.k_cpm import KCPM

WALKS = walks_of_two_styles()


def test_styles_are_told_apart_and_seeded():
    one, two = (KCPM(2, max_iter=15, random_state=1).fit(WALKS) for _ in range(2))
    assert len(set(one.labels_[::2])) == len(set(one.labels_[1::2])) == 1
    assert one.labels_[0] != one.labels_[1]
    np.testing.assert_array_equal(one.labels_, two.labels_)
    assert one.cycles_.shape == (2, one.cpm_.cycle_length_, 2)


def test_more_styles_than_recordings_give_each_its_own():
    assert sorted(KCPM(9, max_iter=3, random_state=0).fit(WALKS[:3]).labels_) == [0, 1, 2]
