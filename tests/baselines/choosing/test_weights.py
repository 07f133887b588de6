import numpy as np
import pandas as pd
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mocapbench.baselines.choosing.candidates import LAST_RESORT, FittedCandidates
from mocapbench.baselines.choosing.held_out_errors import HeldOutErrors
from mocapbench.baselines.choosing.weights import among, evidence, expected_errors, weights_of

SEEDS = st.integers(0, 2**32 - 1)
SHARES = st.floats(0.0, 1.0)


def products(squares, *, correlation=0.0):
    """Return products of errors with these squares and one correlation between all."""
    roots = np.sqrt([*squares.values()])
    correlations = np.where(np.eye(len(roots)), 1.0, correlation)
    return pd.DataFrame(np.outer(roots, roots) * correlations, [*squares], [*squares])


def drawn(seed, n_models=4, n_errors=30):
    """Return the products of errors of models that err alike in part."""
    rng = np.random.default_rng(seed)
    errors = rng.normal(size=n_errors) + rng.normal(size=(n_models, n_errors))
    errors *= rng.lognormal(size=(n_models, 1))
    names = [f"model {k}" for k in range(n_models)]
    return pd.DataFrame(errors @ errors.T / n_errors, names, names)


def expected(weights, table):
    return float(weights @ table.to_numpy() @ weights)


@settings(max_examples=60, deadline=None)
@given(SEEDS, SEEDS)
def test_no_other_weights_err_less_in_what_is_held_out(seed, other):
    table = drawn(seed)
    weights = weights_of([table], 0.0)
    assert [*weights] == [*table]
    values = np.array([*weights.values()])
    assert values.min() >= 0.0
    assert values.sum() == pytest.approx(1.0)
    others = np.random.default_rng(other).dirichlet(np.full(len(table), 0.3), size=50)
    least = expected(values, table)
    assert all(least <= expected(w, table) * (1 + 1e-6) for w in [*others, *np.eye(len(table))])


@settings(max_examples=30, deadline=None)
@given(SEEDS, SEEDS, SHARES, st.floats(1e-3, 1e3))
def test_weights_depend_neither_on_the_unit_of_errors_nor_on_the_order(seed, second, share, unit):
    sources = [drawn(seed), drawn(second)]
    weights = weights_of(sources, share)
    assert weights_of([unit * sources[0], sources[1]], share) == pytest.approx(weights, abs=1e-6)
    turned = [source.iloc[::-1, ::-1] for source in sources]
    assert weights_of(turned, share) == pytest.approx(weights, abs=1e-6)


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
def test_errors_without_correlation_weigh_by_their_inverse_squares(one, other):
    weights = weights_of([products({"a": one, "b": other})], 0.0)
    assert weights["a"] / weights["b"] == pytest.approx(other / one, rel=1e-4)


@given(SEEDS)
def test_with_correlations_of_one_the_best_has_all_the_weight(seed):
    table = drawn(seed)
    best = table.columns[np.diag(table).argmin()]
    assert weights_of([table], 1.0)[best] == pytest.approx(1.0, abs=1e-3)


@given(st.floats(1e-2, 1e2), SHARES)
def test_two_models_weigh_as_in_closed_form(ratio, shrinkage):
    """w_a ∝ σ_b² − ρσ_aσ_b, with ρ the shrinkage where errors have no correlation."""
    weights = weights_of([products({"a": 1.0, "b": ratio**2})], shrinkage)
    raw = [max(ratio**2 - shrinkage * ratio, 0.0), max(1.0 - shrinkage * ratio, 0.0)]
    assume(sum(raw) > 1e-3)
    assert [*weights.values()] == pytest.approx(np.divide(raw, sum(raw)), abs=1e-4)


def test_a_source_counts_in_units_of_its_least_error():
    """Without correlations a model weighs by the inverse of Σ G_s / min G_s."""
    one = products({"a": 1.0, "b": 4.0, "c": 100.0})
    other = products({"a": 60.0, "b": 20.0, "c": 20.0})
    expected = 1.0 / np.array([1.0 + 3.0, 4.0 + 1.0, 100.0 + 1.0])
    weights = weights_of([one, other], 0.0)
    assert [*weights.values()] == pytest.approx(expected / expected.sum())


def test_only_models_that_can_fill_the_recording_are_weighed():
    table = products({"a": 1.0, "b": 2.0, "c": 3.0}, correlation=0.5)
    (kept,) = among([table], {"a", "c", "d"})
    pd.testing.assert_frame_equal(kept, products({"a": 1.0, "c": 3.0}, correlation=0.5))
    assert among([table], {"d"}) == among([], {"a"}) == []


def test_models_that_agree_share_their_weight():
    weights = weights_of([products({"a": 1.0, "b": 1.0}, correlation=1.0)], 0.5)
    assert weights == pytest.approx({"a": 0.5, "b": 0.5})


def test_two_sources_count_alike_whatever_the_size_of_errors_in_them():
    sources = [products({"a": 1.0, "b": 2.0}), products({"a": 2000.0, "b": 1000.0})]
    assert weights_of(sources, 0.5) == pytest.approx({"a": 0.5, "b": 0.5})


def test_without_an_error_the_last_resort_fills():
    assert weights_of([], 0.5) == {LAST_RESORT: 1.0}


class Staged(HeldOutErrors):
    """Given errors, those in the recording itself of so many entries."""

    def __init__(self, own, elsewhere, *, short, n_entries=10**9):
        super().__init__((), FittedCandidates({}), _Gap())
        self.errors, self.hides = (own, elsewhere, short), n_entries

    def in_recording(self, part):
        return self.errors[0]

    def elsewhere(self, part):
        return self.errors[1]

    def n_entries(self, part):
        return self.hides

    def are_short(self, part):
        return self.errors[2]


class _Gap:
    visible = np.array([[True], [False]])


def test_the_recording_and_training_count_alike():
    own = [products({"a": 1.0, "b": 3.0}), products({"a": 3.0, "b": 3.0})]
    training = [(products({"a": 8.0, "b": 3.0}), products({"a": 1.0}))]
    staged = Staged(own, training, short=False)
    assert expected_errors(evidence(staged)) == pytest.approx({"a": 4.0, "b": 3.0})


def test_errors_in_short_copies_grow_as_they_do_in_training():
    """For a from 1 to 4 and for b by nothing; how alike they are stays."""
    training = [(products({"a": 16.0, "b": 3.0}), products({"a": 4.0, "b": 3.0}))]
    own = [products({"a": 1.0, "b": 3.0}, correlation=0.5)]
    found = evidence(Staged(own, training, short=True))
    assert expected_errors(found) == pytest.approx({"a": 8.0, "b": 3.0})
    assert found[0].loc["a", "b"] == pytest.approx(0.5 * np.sqrt(4.0 * 3.0))


@pytest.mark.parametrize(
    ("n_entries", "own"),
    # As in training, where b errs three times as much as a, but half as much in all.
    [(1e-6, {"a": 1.0, "b": 3.0}), (10, {"a": 2.0, "b": 2.0}), (1e9, {"a": 3.0, "b": 1.0})],
)
def test_errors_in_few_entries_are_moved_towards_those_in_training(n_entries, own):
    training = [(products({"a": 2.0, "b": 6.0}, correlation=0.5), pd.DataFrame())]
    staged = Staged([products({"a": 3.0, "b": 1.0})], training, short=False, n_entries=n_entries)
    assert expected_errors(evidence(staged)[:1]) == pytest.approx(own, rel=1e-4)
    assert expected_errors(evidence(staged)[1:]) == pytest.approx({"a": 2.0, "b": 6.0})


def test_a_model_that_errs_hugely_does_not_hide_what_many_entries_say():
    training = [(products({"a": 4.0, "b": 1.0, "spline": 1.0}), pd.DataFrame())]
    own = [products({"a": 1.0, "b": 4.0, "spline": 1000.0})]
    errors = expected_errors(evidence(Staged(own, training, short=False, n_entries=1000))[:1])
    assert errors["a"] < 1.5
    assert errors["b"] == pytest.approx(4.0, rel=0.05)


def test_without_room_training_counts_alone_and_without_training_the_copies():
    training, own = [(products({"a": 8.0}), pd.DataFrame())], [products({"a": 1.0})]
    assert expected_errors(evidence(Staged([], training, short=True))) == pytest.approx({"a": 8.0})
    assert expected_errors(evidence(Staged(own, [], short=True))) == pytest.approx({"a": 1.0})
    assert expected_errors(evidence(Staged([], [], short=True))) == {}


def test_training_counts_alone_where_it_has_no_copies_to_compare_with_the_gaps():
    training = [(products({"a": 8.0}), pd.DataFrame())]
    found = evidence(Staged([products({"a": 1.0})], training, short=True))
    assert [expected_errors([source]) for source in found] == [pytest.approx({"a": 8.0})]
