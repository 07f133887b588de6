import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.choosing.panel import CANDIDATES, LAST_RESORT, Panel
from mocapbench.baselines.choosing.rehearsals import Rehearsals
from mocapbench.baselines.choosing.weights import evidence, expected_errors, weights_of

ERRORS = st.dictionaries(st.sampled_from(sorted(CANDIDATES)), st.floats(1e-6, 1e6), min_size=1)


@settings(max_examples=60, deadline=None)
@given(ERRORS, st.floats(0.5, 20.0))
def test_weights_sum_to_one_and_smaller_errors_weigh_more(errors, power):
    weights = weights_of([errors], power)
    assert sum(weights.values()) == pytest.approx(1.0)
    by_error = [weights[name] for name in sorted(errors, key=errors.get)]
    assert (np.diff(by_error) <= 1e-12).all()


@settings(max_examples=30, deadline=None)
@given(ERRORS, st.floats(1e-3, 1e3))
def test_weights_do_not_depend_on_the_unit_of_errors(errors, unit):
    scaled = weights_of([{name: unit * error for name, error in errors.items()}], 4.0)
    assert scaled == pytest.approx(weights_of([errors], 4.0))


@settings(max_examples=30, deadline=None)
@given(st.floats(1e-2, 1e2), st.floats(1e-2, 1e2))
def test_the_factors_of_two_sources_are_multiplied(one, other):
    sources = [{"linear": 1.0, "lds": one}, {"linear": 1.0, "lds": other}]
    ratios = [w["lds"] / w["linear"] for w in (weights_of([s], 3.0) for s in sources)]
    both = weights_of(sources, 3.0)
    assert both["lds"] / both["linear"] == pytest.approx(ratios[0] * ratios[1])


def test_without_an_error_the_last_resort_fills():
    assert weights_of([], 8.0) == {LAST_RESORT: 1.0}


class Staged(Rehearsals):
    """Rehearsals with given errors."""

    def __init__(self, own, in_training, *, short):
        recording = Panel({})  # not looked at
        object.__setattr__(self, "given", _Gap())
        object.__setattr__(self, "panel", recording)
        object.__setattr__(self, "errors", (own, in_training, short))

    def own(self):
        return self.errors[0]

    def in_training(self):
        return self.errors[1]

    @property
    def are_short(self):
        return self.errors[2]


class _Gap:
    visible = np.array([[True], [False]])


def test_the_recording_and_training_count_alike():
    own = [{"a": 1.0, "b": 3.0}, {"a": 3.0, "b": 3.0}]
    staged = Staged(own, [({"a": 8.0, "b": 3.0}, {"a": 1.0})], short=False)
    assert expected_errors(evidence(staged)) == pytest.approx({"a": 4.0, "b": 3.0})


def test_errors_in_short_copies_grow_as_they_do_in_training():
    """For a from 1 to 4 and for b by nothing, which is then averaged with training."""
    training = [({"a": 16.0, "b": 3.0}, {"a": 4.0, "b": 3.0})]
    staged = Staged([{"a": 1.0, "b": 3.0}], training, short=True)
    assert expected_errors(evidence(staged)) == pytest.approx({"a": 8.0, "b": 3.0})


def test_without_room_training_counts_alone_and_without_training_the_copies():
    training = [({"a": 8.0}, {})]
    assert expected_errors(evidence(Staged([], training, short=True))) == pytest.approx({"a": 8.0})
    assert expected_errors(evidence(Staged([{"a": 1.0}], [], short=True))) == pytest.approx(
        {"a": 1.0}
    )
    assert expected_errors(evidence(Staged([], [], short=True))) == {}


def test_training_counts_alone_where_it_has_no_copies_to_compare_with_the_gaps():
    staged = Staged([{"a": 1.0}], [({"a": 8.0}, {})], short=True)
    assert evidence(staged) == [pytest.approx({"a": 8.0})]
