import math

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import ALPHA, FEWEST_UNITS, holm, unit_means
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.standings import Place, standings
from mocapbench.reports.bundle.layout import CaseLayout

laws = settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
LABELS = ("a", "b", "c", "d")


@st.composite
def tables(draw, fewest=1, most=4):
    """Return {case: {label: folds}} with as many folds in every case."""
    n_cases, n_folds = draw(st.integers(fewest, most)), draw(st.integers(2, 5))
    rng = np.random.default_rng(draw(st.integers(0, 100_000)))
    levels = rng.choice([1.0, 1.1, 2.0, 4.0], size=len(LABELS))
    return {
        f"row {case}": {
            label: list(level + 0.3 * rng.normal(size=n_folds))
            for label, level in zip(LABELS, levels, strict=True)
        }
        for case in range(n_cases)
    }


def standings_of(bundle, metric="mse"):
    return standings(task_results(bundle, bundle.layouts[0]), metric)


def by_label(found):
    return {standing.label: standing for standing in found}


def samples(values):
    """Return the losses of each label over all folds of all cases."""
    return {label: np.concatenate([row[label] for row in values.values()]) for label in LABELS}


@laws
@given(tables())
def test_standings_are_paired_t_tests_against_the_best_with_holms_correction(small, values):
    found = by_label(standings_of(small(values)))
    losses = samples(values)
    best = min(LABELS, key=lambda label: losses[label].mean())
    others = [label for label in LABELS if label != best]
    assert found[best].standing is Place.BEST
    p_values = holm([stats.ttest_rel(losses[o], losses[best]).pvalue for o in others])
    for label, p in zip(others, p_values, strict=True):
        standing = found[label]
        assert standing.n_units == losses[label].size
        assert standing.mean == pytest.approx(losses[label].mean())
        assert standing.difference == pytest.approx(losses[label].mean() - losses[best].mean())
        if standing.n_units < FEWEST_UNITS:
            assert standing.standing is Place.UNTESTED
            assert math.isnan(standing.low)
            continue
        assume(abs(p - ALPHA) > 1e-9)
        assert standing.standing is (Place.BEHIND if p <= ALPHA else Place.INSEPARABLE)
        assert (standing.low > 0.0) == (p <= ALPHA)


@laws
@given(tables(), st.randoms(use_true_random=False))
def test_neither_the_order_of_cases_nor_of_labels_nor_of_folds_matters(small, values, random):
    def mixed(names):
        return random.sample(list(names), len(names))

    n_folds = len(next(iter(values.values()))["a"])
    labels, folds = mixed(LABELS), mixed(range(n_folds))
    moved = {
        case: {label: [values[case][label][fold] for fold in folds] for label in labels}
        for case in mixed(values)
    }
    plain, again = (by_label(standings_of(small(table))) for table in (values, moved))
    for label, standing in plain.items():
        assert again[label].standing is standing.standing
        for name in ("mean", "difference", "low", "high"):
            expected = pytest.approx(getattr(standing, name), abs=1e-9, nan_ok=True)
            assert getattr(again[label], name) == expected


@laws
@given(tables())
def test_a_model_far_behind_never_makes_another_the_best(small, values):
    worse = {
        case: {**row, "hopeless": [100.0 + v for v in row["a"]]} for case, row in values.items()
    }
    plain, beside = (standings_of(small(table)) for table in (values, worse))
    assert beside[0].label == plain[0].label
    assert [s.label for s in beside if s.label != "hopeless"] == [s.label for s in plain]


@laws
@given(tables())
def test_they_are_in_order_and_the_first_is_the_best_of_the_table(small, values):
    bundle = small(values)
    results = task_results(bundle, bundle.layouts[0])
    found = standings(results, "mse")
    assert [s.difference for s in found] == sorted(s.difference for s in found)
    assert found[0].difference == 0.0
    for case in results.cases:
        best, *_ = standings(results, "mse", [case])
        assert best.label == results.best_label(case.name, "mse")
        assert best.mean == pytest.approx(results.estimate(case.name, best.label, "mse").mean)


@laws
@given(tables(fewest=6, most=8))
def test_a_second_recording_of_every_subject_counts_no_more(small, values):
    """Recordings that are repeated under another name change no mean, interval or unit."""
    twice = {**values, **{f"{case} again": values[case] for case in values}}

    def bundle_of(table):
        cases = tuple(CaseLayout(name, {}, subjects=(name.split()[1],)) for name in table)
        return small(table, cases=cases, independent_folds=False)

    plain, repeated = (by_label(standings_of(bundle_of(table))) for table in (values, twice))
    for label, standing in plain.items():
        other = repeated[label]
        assert (other.n_units, other.unit) == (standing.n_units, "subject")
        assert other.n_cases == 2 * standing.n_cases
        assert other.standing is standing.standing
        for name in ("mean", "difference", "low", "high"):
            assert getattr(other, name) == pytest.approx(getattr(standing, name), nan_ok=True)


def test_the_error_is_that_of_clusters(small):
    """Six recordings of five subjects: the mean of six, the scatter of five."""
    rows = {f"{n}{s}": x for n, (s, x) in enumerate(zip("aabcde", (3, 5, 1, 2, 4, 8), strict=True))}
    cases = tuple(CaseLayout(name, {}, subjects=(name[1],)) for name in rows)
    table = {name: {"best": [0.0], "other": [float(x)]} for name, x in rows.items()}
    found = by_label(standings_of(small(table, cases=cases, independent_folds=False)))["other"]
    means, shares = np.array([4.0, 1.0, 2.0, 4.0, 8.0]), np.array([2, 1, 1, 1, 1]) / 6
    middle = np.mean([*rows.values()])
    error = np.sqrt(np.sum(shares**2 / (1 - shares) * (means - middle) ** 2))
    freedom = unit_means(means, shares).freedom
    assert found.difference == pytest.approx(middle)
    assert found.high - found.low == pytest.approx(2 * stats.t.ppf(0.975, freedom) * error)
    assert found.n_units == 5


SIX_FRAMES = {f"{name}": {"a": [1.0], "b": [2.0]} for name in ("07-1", "07-2", "08-1", "08-2")}


def test_below_five_units_nothing_is_tested_and_the_words_say_why(small):
    values = {**SIX_FRAMES, "35-1": {"a": [1.0], "b": [2.1]}, "16-1": {"a": [1.1], "b": [2.0]}}
    cases = tuple(CaseLayout(name, {}, subjects=(name[:2],)) for name in values)
    best, second = standings_of(small(values, cases=cases, independent_folds=False))
    assert (best.label, best.standing, best.n_cases) == ("a", Place.BEST, 6)
    assert (second.standing, second.finding) == (Place.UNTESTED, "too few to test (4 subjects)")


def test_units_of_which_one_has_most_of_the_weight_are_too_few_to_test(small):
    cases = tuple(CaseLayout(f"{n}", {}, subjects=(s,)) for n, s in enumerate("aaaaaabcde"))
    table = {case.name: {"a": [1.0], "b": [2.0 + 0.1 * n]} for n, case in enumerate(cases)}
    _, second = standings_of(small(table, cases=cases, independent_folds=False))
    assert second.finding == "too few to test (5 subjects of unequal weight)"
    assert math.isnan(second.low)


def test_a_label_that_lacks_a_fold_is_incomplete_and_last(small):
    values = {"row": {"a": [1.0, 9.0, 2.0], "fails": [1.1, math.nan, 2.1], "b": [2.0, 9.5, 3.0]}}
    found = standings_of(small(values))
    assert [standing.label for standing in found] == ["a", "b", "fails"]
    assert (found[-1].standing, found[-1].complete) == (Place.INCOMPLETE, False)
    assert found[-1].mean == pytest.approx(1.6)


def test_the_direction_decides_what_is_behind(small):
    values = {"row": {"a": [0.1] * 5, "b": [0.52] * 5}}
    best, second = standings_of(small(values, metric="coverage_50"), "coverage_50")
    assert (best.label, second.label, second.standing) == ("b", "a", Place.BEHIND)
    assert second.difference == pytest.approx(0.38)


def test_without_a_score_there_is_no_standing(small):
    assert standings_of(small({"row": {"a": [math.nan]}})) == ()


def test_a_lone_label_is_best(small):
    (only,) = standings_of(small({"row": {"a": [1.0, 2.0]}}))
    assert (only.standing, only.difference) == (Place.BEST, 0.0)
