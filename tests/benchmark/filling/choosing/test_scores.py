import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing.scores import list_gaps, score_gaps, weigh_gaps
from mocapbench.benchmark.filling.gap_problem import PredictedEntries


@pytest.fixture
def first(held_out, hidden):
    """Return a hold-out of gaps in degrees and centimetres."""
    return held_out(hidden((50, 54, [0, 3]), (80, 84, [1])))[0]


def test_scores_are_closed_forms_for_each_gap_and_unit(first):
    """Angles are off by 1 and 2 degrees in turn, a place by one centimetre a frame of its gap."""
    off = np.where(np.arange(len(first.truth)) % 2, 1.0, 2.0)
    expected = []
    for gap in first.gaps:
        if gap.kind.unit == "cm":
            off[gap.entries] = len(gap.copy)
        expected.append(np.sqrt(np.mean(off[gap.entries] ** 2)))
    errors = score_gaps([first], [PredictedEntries(first.truth + off, None)])
    np.testing.assert_allclose(errors, expected)
    assert {gap.kind.unit for gap in first.gaps} == {"cm", "deg"}


def test_of_more_hold_outs_than_predictions_the_first_are_scored(held_out, hidden):
    hold_outs = held_out(hidden((50, 54, [0])))
    predictions = [PredictedEntries(one.truth + 1.0, None) for one in hold_outs[:2]]
    assert len(score_gaps(hold_outs, predictions)) == len(list_gaps(hold_outs[:2]))


def test_errors_of_rounding_are_no_lead(first):
    exact, rounded = (
        score_gaps([first], [PredictedEntries(first.truth + off, None)]) for off in (0.0, 1e-13)
    )
    np.testing.assert_array_equal(exact, rounded)


def test_a_gap_counts_by_its_entries_however_many_copies_it_has(held_out, hidden):
    gaps = list_gaps(held_out(hidden((5, 15, [0]), (60, 90, [1, 2]), (150, 155, [3]))))
    weights = weigh_gaps(gaps)
    totals = dict.fromkeys((10, 60, 5), 0.0)
    for weight, gap in zip(weights, gaps, strict=True):
        totals[len(gap.original) * len(gap.original.channels)] += weight
    assert weights.mean() == pytest.approx(1.0)
    shares = {entries: total / len(weights) for entries, total in totals.items()}
    assert shares == pytest.approx({10: 10 / 75, 60: 60 / 75, 5: 5 / 75})
