from itertools import combinations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mocapbench.metrics.statistics import contrast, holm
from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import contrasts
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.standings import Place, standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.tables.pairs import contrast_table

VALUES = {
    f"row {number}": {"a": [0.1 * number], "b": [0.5 + 0.101 * number], "c": [0.11 * number]}
    for number in range(1, 7)
}


def results_of(bundle):
    return task_results(bundle, bundle.layouts[0])


def contrast_of(results, *pair):
    return contrasts(cells(results, "mse"))[pair]


def cell(table, one, other):
    row = next(row for row in table.rows if row[0].text == one)
    return row[[column.text for column in table.columns].index(f"than {other}")]


laws = settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])


@laws
@given(st.integers(0, 100_000))
def test_all_pairs_at_once_are_the_contrasts_one_by_one(small, seed):
    """Also where some labels lack a fold, so that pairs have units of their own."""
    rng = np.random.default_rng(seed)
    folds = rng.normal((1.0, 1.3, 2.0, 2.1), size=(8, 4))
    folds[rng.integers(8), 2] = np.nan
    results = results_of(small({"row": dict(zip("abcd", folds.T.tolist(), strict=True))}))
    table = results.scores.pivot(index="fold", columns="label", values="value")
    for pair, many in contrasts(cells(results, "mse")).items():
        units = table[list(pair)].dropna().set_axis(["first", "second"], axis=1)
        advantages = units["second"] - units["first"]
        one = contrast(units.assign(advantage=advantages, share=1.0 / len(units)))
        for name in ("n", "first", "second", "advantage", "t_p"):
            assert getattr(many, name) == pytest.approx(getattr(one, name), abs=1e-9)
        assert many.separable == (not many.low <= 0.0 <= many.high)


def test_a_second_recording_of_every_subject_changes_no_contrast(small):
    twice = {**VALUES, **{f"{case} again": folds for case, folds in VALUES.items()}}
    once, again = (
        contrast_of(
            results_of(
                small(
                    table,
                    cases=tuple(CaseLayout(c, {}, subjects=(c.split()[1],)) for c in table),
                    independent_folds=False,
                )
            ),
            *("a", "b"),
        )
        for table in (VALUES, twice)
    )
    assert (once.n, again.n) == (6, 6)
    for name in ("first", "second", "advantage", "low", "high", "t_p"):
        assert getattr(again, name) == pytest.approx(getattr(once, name))


@laws
@given(st.integers(0, 100_000))
def test_pairs_with_the_best_are_those_of_the_standings_and_others_a_family(small, seed):
    folds = np.random.default_rng(seed).normal((1.0, 1.3, 2.0, 2.1), size=(8, 4))
    results = results_of(small({"row": dict(zip("abcd", folds.T.tolist(), strict=True))}))
    by_pair = contrasts(cells(results, "mse"))
    best, *others = standings(results, "mse")
    for standing in others:
        found = by_pair[best.label, standing.label]
        assert found.advantage == pytest.approx(standing.difference)
        assert (found.low, found.high) == pytest.approx((standing.low, standing.high))
        assert found.separable == (standing.standing is Place.BEHIND)
    rest = [pair for pair in combinations("abcd", 2) if best.label not in pair]
    corrected = holm([by_pair[pair].t_p for pair in rest])
    assert [by_pair[pair].t_p_holm for pair in rest] == pytest.approx(corrected)


def test_the_matrix_shows_the_difference_and_its_interval(small):
    table = contrast_table(results_of(small(VALUES)), "mse")
    found = cell(table, "a", "b")
    assert (found.text, found.kind) == ("0.50", "contrast ahead")
    assert found.note.replace("\N{NO-BREAK SPACE}", " ") == "0.50 to 0.51"
    assert cell(table, "a", "a").kind == "absent"


def test_the_matrix_is_antisymmetric(small):
    table = contrast_table(results_of(small(VALUES)), "mse")
    there, back = cell(table, "a", "b"), cell(table, "b", "a")
    assert (back.text, back.kind) == (f"−{there.text}", "contrast behind")
    assert back.note.replace("\N{NO-BREAK SPACE}", " ") == "−0.51 to −0.50"


def test_a_mark_stands_only_where_the_test_separates(small):
    values = {case: {**labels, "d": [labels["a"][0]]} for case, labels in VALUES.items()}
    table = contrast_table(results_of(small(values)), "mse")
    assert cell(table, "a", "d").kind == "contrast"
    assert cell(table, "a", "d").text == "0.000"


@laws
@given(st.integers(0, 100_000), st.sets(st.integers(0, 7), min_size=1, max_size=2))
def test_the_matrix_leaves_out_what_lost_folds_and_is_over_as_many_as_it_says(small, seed, lost):
    folds = np.random.default_rng(seed).normal((1.0, 1.3, 2.0, 0.1), size=(8, 4))
    folds[list(lost), 3] = np.nan
    results = results_of(small({"row": dict(zip("abcd", folds.T.tolist(), strict=True))}))
    table = contrast_table(results, "mse")
    assert [row[0].text for row in table.rows] == ["a", "b", "c"]
    assert {contrast_of(results, *pair).n for pair in combinations("abc", 2)} == {8}
    assert table.caption.endswith("over 8 folds")
    assert table.notes == (f"Left out, as they are incomplete: d ({8 - len(lost)} of 8 folds).",)


def test_a_lone_complete_entrant_is_no_matrix(small):
    values = {"row": {"a": [1.0] * 8, "b": [2.0] * 7 + [np.nan]}}
    assert contrast_table(results_of(small(values)), "mse") is None


def test_the_caption_names_the_units(small):
    assert "over 6 folds" in contrast_table(results_of(small(VALUES)), "mse").caption
    cases = tuple(CaseLayout(name, {}, subjects=(name,)) for name in VALUES)
    table = contrast_table(results_of(small(VALUES, cases=cases)), "mse")
    assert "over 6 subjects" in table.caption


@pytest.mark.parametrize("n", [1, 4])
def test_too_few_units_are_no_matrix(small, n):
    values = {"row": {"a": [1.0, 1.1, 0.9, 1.0][:n], "b": [2.0, 2.2, 2.1, 2.0][:n]}}
    assert contrast_table(results_of(small(values)), "mse") is None


def test_windows_of_one_recording_are_no_matrix(small):
    values = {"row": {"a": [1.0] * 9, "b": [2.0] * 9}}
    assert contrast_table(results_of(small(values, independent_folds=False)), "mse") is None


def test_a_lone_entrant_and_the_oracle_are_not_contrasted(small):
    bundle = small({name: {"a": [1.0], "oracle": [0.5]} for name in "uvwxyz"})
    assert contrast_table(results_of(bundle), "mse") is None


def test_generated_motion_is_left_out_beside_recordings(small):
    cases = (
        CaseLayout("row 1", {}, synthetic=True),
        *(CaseLayout(c, {}) for c in VALUES if "1" not in c),
    )
    assert contrast_of(results_of(small(VALUES, cases=cases)), "a", "b").n == 5


def test_an_untested_contrast_is_never_separable(small):
    found = contrast_of(results_of(small({"row": {"a": [1.0], "b": [9.0]}})), "a", "b")
    assert (found.tested, found.separable, found.n) == (False, False, 1)
    assert np.isnan(found.t_p_holm)


@laws
@given(st.integers(0, 100_000))
def test_a_label_without_all_scores_is_in_no_test_of_the_standings(small, seed):
    folds = np.random.default_rng(seed).normal((1.0, 1.3, 2.0, 2.1), size=(8, 4))
    folds[3, 3] = np.nan
    results = results_of(small({"row": dict(zip("abcd", folds.T.tolist(), strict=True))}))
    by_pair = contrasts(cells(results, "mse"))
    best, *others = standings(results, "mse")
    complete = [(best.label, other.label) for other in others if other.complete]
    rest = [pair for pair in combinations("abcd", 2) if {*pair} not in map(set, complete)]
    for family in (complete, rest):
        corrected = holm([by_pair[pair].t_p for pair in family])
        assert [by_pair[pair].t_p_holm for pair in family] == pytest.approx(corrected)
