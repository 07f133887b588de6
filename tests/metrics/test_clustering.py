import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import Clustering, adjusted_rand, purity

PARTITIONS = st.integers(1, 30).flatmap(
    lambda n: st.tuples(*[st.lists(st.integers(0, 4), min_size=n, max_size=n)] * 2)
)


def _outcome(truth, labels):
    return Clustering(np.array(truth), np.array(labels, dtype=np.intp))


def test_purity_is_the_weighted_share_of_the_majorities():
    outcome = _outcome(["a", "a", "b", "b", "b", "c"], [0, 0, 0, 1, 1, 1])
    assert purity(outcome).value == pytest.approx((3 / 6) * (2 / 3) + (3 / 6) * (2 / 3))


def test_one_cluster_has_the_share_of_the_largest_class():
    outcome = _outcome(["a", "b", "b", "b"], [5, 5, 5, 5])
    assert purity(outcome).value == 0.75
    assert adjusted_rand(outcome).value == 0.0


@given(PARTITIONS)
def test_names_of_classes_and_clusters_mean_nothing(partitions):
    truth, labels = map(np.array, partitions)
    for metric in (purity, adjusted_rand):
        renamed = _outcome([f"style {t}" for t in 7 - truth], (labels + 3) % 5)
        assert metric(renamed).value == pytest.approx(metric(_outcome(truth, labels)).value)


@given(PARTITIONS)
def test_the_classes_themselves_score_one(partitions):
    truth, _ = partitions
    assert purity(_outcome(truth, truth)).value == 1.0
    assert adjusted_rand(_outcome(truth, truth)).value == 1.0


@given(PARTITIONS)
def test_splitting_a_cluster_never_lowers_purity(partitions):
    truth, labels = map(np.array, partitions)
    whole, split = _outcome(truth, labels), _outcome(truth, 2 * labels + np.arange(len(labels)) % 2)
    assert purity(split).value >= purity(whole).value - 1e-12


def test_the_rand_index_counts_pairs():
    """Four together in each, of ten pairs: (agreements − chance) / (most − chance)."""
    truth, labels = [0, 0, 0, 1, 1], [0, 0, 1, 1, 1]
    together, pairs_truth, pairs_labels, pairs = 1 + 1, 3 + 1, 1 + 3, 10
    chance = pairs_truth * pairs_labels / pairs
    expected = (together - chance) / ((pairs_truth + pairs_labels) / 2 - chance)
    assert adjusted_rand(_outcome(truth, labels)).value == pytest.approx(expected)


def test_random_clusters_have_no_rand_index_on_average():
    rng = np.random.default_rng(0)
    truth = np.repeat(np.arange(4), 10)
    values = [adjusted_rand(_outcome(truth, rng.permutation(truth))).value for _ in range(500)]
    assert abs(np.mean(values)) < 4 * np.std(values) / np.sqrt(500)


@pytest.mark.parametrize("metric", [purity, adjusted_rand], ids=lambda metric: metric.name)
@pytest.mark.parametrize(("truth", "labels"), [([], []), ([0, 1], [0]), ([[0]], [[0]])])
def test_clusters_that_do_not_match_the_classes_are_refused(metric, truth, labels):
    with pytest.raises(ValueError, match="expected one class and one cluster"):
        metric(_outcome(truth, labels))
