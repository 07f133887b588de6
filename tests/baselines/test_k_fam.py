import numpy as np
from samples import walks_of_two_styles

from mocapbench.baselines.fam import FAM
from mocapbench.baselines.k_fam import KFAM

WALKS = walks_of_two_styles()


def test_styles_are_told_apart_and_seeded():
    one, two = (KFAM(2, random_state=1).fit(WALKS) for _ in range(2))
    assert len(set(one.labels_[::2])) == len(set(one.labels_[1::2])) == 1
    assert one.labels_[0] != one.labels_[1]
    np.testing.assert_array_equal(one.labels_, two.labels_)


def test_a_styles_cycle_is_the_mean_of_its_recordings_cycles():
    model = KFAM(2, random_state=1).fit(WALKS)
    fam = FAM(n_restarts=1, random_state=np.random.default_rng(1)).fit(WALKS)
    np.testing.assert_allclose(model.fam_.prototypes_, fam.prototypes_)
    for label in (0, 1):
        expected = fam.prototypes_[model.labels_ == label].mean(axis=0)
        np.testing.assert_allclose(model.cycles_[label], expected)


def test_it_aligns_as_the_functional_analysis_does():
    model = KFAM(2, random_state=1).fit(WALKS)
    for path, again in zip(model.path_, model.fam_.path_, strict=True):
        np.testing.assert_array_equal(path, again)
    for path, again in zip(model.align(WALKS), model.fam_.align(WALKS), strict=True):
        np.testing.assert_array_equal(path, again)


def test_more_styles_than_recordings_give_each_its_own():
    assert sorted(KFAM(9, random_state=0).fit(WALKS[:3]).labels_) == [0, 1, 2]
