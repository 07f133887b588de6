import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.comparisons import (
    PublishedVerdict,
    allowance,
    comparisons,
    verdict,
)
from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.tables.letters import letters
from mocapbench.reports.tables.verdicts import verdict_table

LOWER = MetricInfo("m", "M", Direction.LOWER)
HIGHER = MetricInfo("m", "M", Direction.HIGHER)
sizes = st.floats(0.01, 1e3)
spreads = st.none() | sizes


def printed(value, two_sd=None):
    return PublishedValue("table", "task", "case", "M", "model", value, two_sd)


@given(sizes, spreads)
def test_the_allowance_is_two_per_cent_or_the_printed_spread(value, two_sd):
    assert allowance(printed(value, two_sd)) == max(0.02 * value, two_sd or 0.0)
    assert allowance(printed(-value, two_sd)) == allowance(printed(value, two_sd))


WITHIN = {PublishedVerdict.WITHIN_2_PERCENT, PublishedVerdict.WITHIN_PAPER_SD}


@given(sizes, st.floats(-0.99, 0.99), spreads, st.none() | st.floats(0.0, 0.99))
def test_a_near_mean_that_is_sure_is_within_one_of_the_two(value, share, two_sd, certainty):
    published = printed(value, two_sd)
    allowed = allowance(published)
    half_width = None if certainty is None else certainty * allowed
    found = verdict(value + share * allowed, published, LOWER, half_width)
    assert found in WITHIN
    near = max(abs(share), certainty or 0.0) * allowed <= 0.02 * value * (1.0 - 1e-9)
    far = max(abs(share), certainty or 0.0) * allowed >= 0.02 * value * (1.0 + 1e-9)
    assert not (near and found is PublishedVerdict.WITHIN_PAPER_SD)
    assert not (far and found is PublishedVerdict.WITHIN_2_PERCENT)


@pytest.mark.parametrize(
    ("ours", "half_width", "expected"),
    [
        (102.0, 2.0, PublishedVerdict.WITHIN_2_PERCENT),
        (108.0, 8.0, PublishedVerdict.WITHIN_PAPER_SD),
        (112.0, 4.0, PublishedVerdict.UNDECIDED),
    ],
)
def test_what_is_at_an_edge_is_within_it(ours, half_width, expected):
    assert verdict(ours, printed(100.0, 8.0), LOWER, half_width) is expected


@given(sizes, sizes)
def test_without_a_printed_spread_nothing_is_within_it(ours, value):
    assert verdict(ours, printed(value), LOWER) is not PublishedVerdict.WITHIN_PAPER_SD


@given(sizes, sizes, spreads, sizes, st.sampled_from([LOWER, HIGHER]))
def test_noise_only_ever_weakens_a_verdict(ours, value, two_sd, half_width, info):
    published = printed(value, two_sd)
    bare = verdict(ours, published, info)
    assert bare is not PublishedVerdict.UNDECIDED
    weaker = {PublishedVerdict.WITHIN_2_PERCENT: {PublishedVerdict.WITHIN_PAPER_SD}}.get(
        bare, set()
    )
    found = verdict(ours, published, info, half_width)
    assert found in {bare, PublishedVerdict.UNDECIDED} | weaker


@given(sizes, sizes, spreads, sizes, st.floats(1.0, 100.0))
def test_what_is_undecided_stays_so_under_more_noise(ours, value, two_sd, half_width, factor):
    published = printed(value, two_sd)
    if verdict(ours, published, LOWER, half_width) is PublishedVerdict.UNDECIDED:
        assert verdict(ours, published, LOWER, factor * half_width) is PublishedVerdict.UNDECIDED


@given(sizes, st.floats(1.01, 1e3))
def test_a_mean_too_noisy_to_tell_is_undecided_however_well_it_agrees(value, factor):
    published = printed(value)
    assert (
        verdict(value, published, LOWER, factor * allowance(published))
        is PublishedVerdict.UNDECIDED
    )


@given(sizes, sizes, st.floats(0.0, 10.0))
def test_the_direction_mirrors_the_verdict(ours, value, half_width):
    mirror = {
        PublishedVerdict.BETTER: PublishedVerdict.WORSE,
        PublishedVerdict.WORSE: PublishedVerdict.BETTER,
    }
    lower, higher = (verdict(ours, printed(value), info, half_width) for info in (LOWER, HIGHER))
    assert higher is mirror.get(lower, lower)


def test_as_far_from_the_target_on_its_other_side_is_no_better():
    around = MetricInfo("m", "M", Direction.TARGET, 0.5)
    for ours, theirs in ((0.25, 0.75), (0.75, 0.25)):
        assert verdict(ours, printed(theirs), around) is not PublishedVerdict.BETTER


@pytest.mark.parametrize(
    ("ours", "half_width", "expected"),
    [
        (1.0, 0.85, PublishedVerdict.BETTER),  # 2.0 lies beyond 1.0 + 0.85 + 0.1
        (1.0, 0.95, PublishedVerdict.UNDECIDED),
        (3.0, 0.85, PublishedVerdict.WORSE),
        (3.0, 0.95, PublishedVerdict.UNDECIDED),
        (2.03, 0.03, PublishedVerdict.WITHIN_2_PERCENT),
        (2.03, 0.05, PublishedVerdict.WITHIN_PAPER_SD),
        (2.05, 0.05, PublishedVerdict.WITHIN_PAPER_SD),
        (2.05, 0.15, PublishedVerdict.UNDECIDED),
    ],
)
def test_verdicts_beside_two_plus_or_minus_a_tenth(ours, half_width, expected):
    assert verdict(ours, printed(2.0, 0.1), LOWER, half_width) is expected


def pairs_of(bundle, task, metric):
    return comparisons(task_results(bundle, bundle.layouts[task]), metric)


def test_every_value_with_a_counterpart_is_compared(bundle):
    assert len(pairs_of(bundle, 0, "mse")) == 18
    assert len(pairs_of(bundle, 1, "msll")) == 16
    assert len(pairs_of(bundle, 2, "rms_per_frame")) == 24  # two of eight recordings are missing


def test_a_reason_forbids_the_comparison(bundle):
    pairs = [pair for pair in pairs_of(bundle, 2, "rms_per_frame") if pair.label == "knn"]
    assert {pair.verdict for pair in pairs} == {PublishedVerdict.NOT_COMPARABLE}
    assert {pair.reason for pair in pairs} == {"the paper does not print its KNN objective"}


def spline_on_35_03(small, folds, *, synthetic=False, **fields):
    """Return a bundle whose one published value is 62.98."""
    return small(
        {"row": {"cubic-spline": folds}},
        metric="rms_per_frame",
        task="missing-frames",
        cases=(CaseLayout("row", {}, synthetic=synthetic),),
        published_rows={"row": "35-03"},
        published_models={"cubic-spline": "cubic-spline"},
        published_metrics={"rms_per_frame": "RMS per frame"},
        **fields,
    )


def test_generated_motion_is_not_comparable(small):
    (pair,) = pairs_of(spline_on_35_03(small, [62.98], synthetic=True), 0, "rms_per_frame")
    assert (pair.verdict, pair.reason) == (PublishedVerdict.NOT_COMPARABLE, "generated motion")
    assert not pair.on_one_fold


WINDOWS = [62.99 + step for step in (-30.0, -20.0, -10.0, 10.0, 20.0, 30.0)]


@pytest.mark.parametrize(
    ("independent", "expected"),
    [(True, PublishedVerdict.UNDECIDED), (False, PublishedVerdict.WITHIN_2_PERCENT)],
)
def test_the_spread_of_windows_is_no_uncertainty(small, independent, expected):
    bundle = spline_on_35_03(small, WINDOWS, independent_folds=independent)
    (pair,) = pairs_of(bundle, 0, "rms_per_frame")
    assert pair.verdict is expected
    assert (pair.ours.half_width is None) is not independent


def test_noisy_folds_about_another_mean_are_not_reproduced(small):
    (pair,) = pairs_of(spline_on_35_03(small, [40.0, 70.0, 100.0]), 0, "rms_per_frame")
    assert abs(pair.ours.mean - 62.98) < pair.ours.two_sd
    assert pair.verdict is PublishedVerdict.UNDECIDED


def test_a_verdict_on_one_fold_says_so(small):
    for folds, words in (([62.98], "one fold"), ([62.98, 62.98], "")):
        bundle = spline_on_35_03(small, folds)
        results = task_results(bundle, bundle.layouts[0])
        (row,) = verdict_table(results, "rms_per_frame").rows
        assert (row[-1].text, row[-1].note) == ("within 2 %", words)


def test_the_table_holds_ours_theirs_and_the_difference(bundle):
    results = task_results(bundle, bundle.layouts[0])
    table = verdict_table(results, "mse")
    assert table.rows[0][0].text == "test 1"
    for row, pair in zip(table.rows, comparisons(results, "mse"), strict=True):
        ours, theirs, difference = (float(cell.text.replace("−", "-")) for cell in row[4:7])
        assert ours == pytest.approx(pair.ours.mean, abs=0.005)
        assert theirs == pytest.approx(pair.published.value, abs=0.005)
        assert difference == pytest.approx(ours - theirs, abs=0.0101)
        assert row[7].text == pair.verdict.value


def test_undecided_are_wide_or_near_and_reproduced_are_near_and_narrow(bundle):
    pairs = comparisons(task_results(bundle, bundle.layouts[0]), "mse")
    for pair in pairs:
        difference = abs(pair.ours.mean - pair.published.value)
        allowed, half = allowance(pair.published), pair.ours.half_width
        if pair.verdict is PublishedVerdict.UNDECIDED:
            assert half + allowed >= difference
        if pair.verdict.value.startswith("within"):
            assert max(half, difference) <= allowed


def test_no_table_where_the_paper_has_nothing(small):
    bundle = small({"row": {"a": [1.0]}})
    assert verdict_table(task_results(bundle, bundle.layouts[0]), "mse") is None


def test_an_erratum_is_marked_with_the_letter_that_it_has_in_all_tables_of_the_task(bundle):
    results = task_results(bundle, bundle.layouts[0])
    table = verdict_table(results, "mse")
    marked = [(row[0].text, row[2].text) for row in table.rows if row[5].mark]
    assert marked == [("test 4", "MOHGP"), ("test 7", "MOHGP"), ("test 2", "MOA")]
    assert not table.notes
    lettered = {letter: note for note, letter in letters(results).items()}
    assert lettered["a"].startswith("The thesis prints identical")
    assert "cannot both be right" in lettered["b"]


def test_a_row_may_have_a_reason_of_its_own(small):
    bundle = spline_on_35_03(small, [62.98])
    reasons = {("row", "cubic-spline"): "another training set"}
    page = dataclasses.replace(bundle.layouts[0].page, not_comparable_rows=reasons)
    layout = dataclasses.replace(bundle.layouts[0], page=page)
    (pair,) = comparisons(
        task_results(dataclasses.replace(bundle, layouts=(layout,)), layout), "rms_per_frame"
    )
    assert (pair.verdict, pair.reason) == (PublishedVerdict.NOT_COMPARABLE, "another training set")


def test_a_remark_on_the_published_value_is_a_reason(small):
    bundle = small(
        {"row": {"replay": [1.0]}},
        task="control-similarity",
        published_rows={"row": "12(1) vs 16(15)"},
        published_metrics={"mse": "MCC"},
        published_models={"replay": "real"},
    )
    results = task_results(bundle, bundle.layouts[0])
    (pair,) = comparisons(results, "mse")
    assert pair.verdict is PublishedVerdict.NOT_COMPARABLE
    assert "approached" in pair.reason
    (row,) = verdict_table(results, "mse").rows
    assert row[6].text == "−19.55"
