import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.units import unit_names, unit_weights
from mocapbench.reports.bundle.layout import CaseLayout

addresses = st.lists(st.tuples(st.sampled_from("xyz"), st.sampled_from("abcd")), min_size=1)


@pytest.mark.parametrize(
    ("subjects", "independent", "names"),
    [
        (("35",), True, ["subject 35"] * 3),
        (("35",), False, ["subject 35"] * 3),
        (("35", "10"), True, ["subject 35", "subject 10", "subject 35"]),
        ((), True, ["fold 0 of row", "fold 1 of row", "fold 2 of row"]),
        ((), False, ["case row"] * 3),
    ],
)
def test_the_unit_of_a_fold(subjects, independent, names):
    case = CaseLayout("row", {}, subjects=subjects)
    assert unit_names(case, [0, 1, 2], independent=independent) == names


@given(addresses)
def test_the_mean_over_units_by_their_shares_is_the_mean_over_cases(pairs):
    units, cases = zip(*pairs, strict=True)
    values = np.arange(len(pairs), dtype=float)
    weights = unit_weights(units, cases)
    shares = weights.sum(axis=1)
    of_cases = [
        np.mean([v for v, name in zip(values, cases, strict=True) if name == case])
        for case in set(cases)
    ]
    assert shares.sum() == pytest.approx(1.0)
    assert shares @ (weights @ values / shares) == pytest.approx(np.mean(of_cases))


def test_weights_take_memory_for_each_cell_but_not_for_each_pair_of_unit_and_cell():
    units = [f"fold {number}" for number in range(100_000)]
    weights = unit_weights(units, ["row"] * len(units))
    assert weights.nnz == len(units)
    assert weights.sum() == pytest.approx(1.0)


def test_a_subjects_two_recordings_are_one_unit(small):
    values = {name: {"a": [1.0, 3.0], "b": [2.0, 4.0]} for name in ("07-01", "07-02", "35-03")}
    cases = tuple(CaseLayout(name, {}, subjects=(name[:2],)) for name in values)
    bundle = small(values, cases=cases, independent_folds=False)
    scored = cells(task_results(bundle, bundle.layouts[0]), "mse")
    assert (scored.n_units(0), scored.n_cases(0), scored.unit) == (2, 3, "subject")


def test_the_loss_of_a_case_is_the_mean_of_its_cells_losses(small):
    """Also where the metric has a target, and folds lie on both sides of it."""
    values = {"row": {"a": [0.2, 0.6, 0.3]}, "other": {"a": [0.7, 0.4, 0.9]}}
    bundle = small(values, metric="coverage_50")
    results = task_results(bundle, bundle.layouts[0])
    for case in results.cases:
        scored = cells(results, "coverage_50", [case])
        mean = np.mean(values[case.name]["a"])
        assert scored.losses.mean() == pytest.approx(abs(mean - 0.5))
