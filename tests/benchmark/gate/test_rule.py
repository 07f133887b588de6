"""The rule of the gate, without a run."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.rule import DEFAULT_TOLERANCES, FAILING, Tolerance, Verdict, judge
from mocapbench.benchmark.registry import METRICS

MSE, MLC, COVERAGE = (METRICS.get(name).loss for name in ("mse", "mlc", "coverage_90"))
SAME, CROSS = (DEFAULT_TOLERANCES[environment] for environment in Environment)
values = st.floats(0.01, 100.0)
folds = st.lists(st.tuples(values, values), min_size=1, max_size=12)


def _verdict(reference, run, loss=MSE, tolerance=SAME):
    return judge(reference, run, loss, tolerance).verdict


@given(st.lists(values, min_size=1, max_size=12), st.sampled_from([MSE, MLC, COVERAGE]))
def test_a_run_that_repeats_its_reference_is_the_same(found, loss):
    assert _verdict(found, found, loss) is Verdict.SAME


@given(folds, st.randoms())
def test_the_order_of_folds_means_nothing(pairs, random):
    shuffled = random.sample(pairs, len(pairs))
    one, two = (judge(*zip(*each, strict=True), MSE, CROSS) for each in (pairs, shuffled))
    assert one.change == pytest.approx(two.change, abs=1e-9)
    assert one.allowance == pytest.approx(two.allowance, abs=1e-9)


@given(folds)
def test_worse_one_way_is_better_the_other(pairs):
    reference, run = zip(*pairs, strict=True)
    exact = Tolerance(relative=0.0)
    forth, back = judge(reference, run, MSE, exact), judge(run, reference, MSE, exact)
    opposite = {Verdict.WORSE: Verdict.BETTER, Verdict.BETTER: Verdict.WORSE}
    decided = abs(forth.change) > 1e-9 + forth.allowance
    assume(decided)
    assert back.verdict is opposite[forth.verdict]


@given(folds)
def test_higher_is_better_where_the_metric_says_so(pairs):
    reference, run = zip(*pairs, strict=True)
    lower, higher = (judge(reference, run, loss, CROSS) for loss in (MSE, MLC))
    assert lower.change == pytest.approx(-higher.change, abs=1e-12)


@pytest.mark.parametrize(
    ("before", "after", "verdict"),
    [(0.90, 0.80, "worse"), (0.90, 0.97, "worse"), (0.80, 0.88, "better"), (0.85, 0.95, "same")],
)
def test_coverage_is_judged_by_its_distance_from_the_target(before, after, verdict):
    assert _verdict([before], [after], COVERAGE) == verdict


def test_the_relative_floor_is_of_the_references_mean():
    assert _verdict([1.0, 3.0], [1.039, 3.039], tolerance=CROSS) is Verdict.SAME
    assert _verdict([1.0, 3.0], [1.041, 3.041], tolerance=CROSS) is Verdict.WORSE


def test_the_absolute_floor_counts_where_the_mean_is_near_zero():
    assert _verdict([0.0], [1e-12]) is Verdict.WORSE
    assert _verdict([0.0], [1e-12], tolerance=Tolerance(absolute=1e-9)) is Verdict.SAME


def test_the_allowance_is_k_standard_errors_of_the_paired_differences():
    differences = np.array([0.1, 0.3, -0.2, 0.4, 0.05])
    judgement = judge(np.ones(5), 1 + differences, MSE, SAME)
    assert judgement.allowance == pytest.approx(3 * differences.std(ddof=1) / np.sqrt(5))
    assert judgement.change == pytest.approx(differences.mean())
    assert judgement.worst == pytest.approx(0.4)


def test_pairs_cancel_how_hard_a_fold_is():
    hard = np.array([1.0, 10.0, 100.0, 1000.0, 10000.0])
    assert _verdict(hard, hard + 1000.0, tolerance=CROSS) is Verdict.WORSE


@pytest.mark.filterwarnings("error")
def test_one_fold_has_no_standard_error():
    assert judge([1.0], [1.1], MSE, CROSS).allowance == CROSS.floor(1.0)


def test_equal_differences_have_no_standard_error_to_hide_behind():
    assert _verdict([1.0] * 5, [1.1] * 5) is Verdict.WORSE
    assert _verdict([1.0], [1.1]) is Verdict.WORSE


def test_a_fold_that_is_worse_is_seen_though_the_mean_is_not_beyond_doubt():
    """Two folds that got worse by much and by more have a mean within three standard errors."""
    assert _verdict([1.0, 1.0], [2.0, 5.0]) is Verdict.MOVED
    assert Verdict.MOVED in FAILING[Environment.SAME]
    assert Verdict.MOVED not in FAILING[Environment.CROSS]


def test_one_fold_alone_is_never_beyond_doubt_however_far_it_runs_off():
    judgement = judge([1.0] * 5, [1.0] * 4 + [1e6], MSE, CROSS)
    assert judgement.verdict is Verdict.MOVED
    assert judgement.allowance == pytest.approx(CROSS.k * judgement.change)


def test_no_fold_worse_and_one_better_is_better():
    assert _verdict([1.0, 1.0], [1.0, 0.5]) is Verdict.BETTER


@pytest.mark.parametrize("pair", [([], []), ([1.0], [np.nan]), ([np.inf], [1.0])])
def test_what_cannot_be_paired_is_refused(pair):
    with pytest.raises(ValueError, match="expected finite values in pairs"):
        judge(*pair, MSE, SAME)


@pytest.mark.parametrize("absolute", [0.0, 0.5])
def test_what_changes_by_no_more_than_the_floor_has_not_changed(absolute):
    """Also where the floor is 0: a metric that is 0 on both sides is the same."""
    tolerance = Tolerance(relative=0.0, absolute=absolute)
    for change in (absolute, -absolute):
        assert _verdict([1.0], [1.0 + change], tolerance=tolerance) is Verdict.SAME
        assert _verdict([1.0, 1.0], [1.0 + change, 1.0], tolerance=tolerance) is Verdict.SAME
    assert _verdict([0.0, 0.0], [0.0, 0.0]) is Verdict.SAME
