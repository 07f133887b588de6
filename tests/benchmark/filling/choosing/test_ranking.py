import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.choosing.hold_outs import make_hold_outs
from mocapbench.benchmark.filling.choosing.ranking import number_positions, rank, share_evidence
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.datasets import Recording

ERRORS = {
    "bad": [2.0, 2.1, 2.2, 1.9, 2.0],
    "as good": [1.1, 1.1, 1.0, 1.0, 1.05],
    "good": [1.0, 1.2, 0.9, 1.1, 1.0],
}


def ranking_of(errors, positions=None):
    errors = {model: np.array(each, dtype=float) for model, each in errors.items()}
    n = len(next(iter(errors.values())))
    return rank(errors, np.ones(n), np.arange(n) if positions is None else np.array(positions))


def test_models_that_the_test_does_not_separate_from_the_first_share_its_position():
    found = ranking_of(ERRORS)
    assert found.order == ("good", "as good", "bad")
    assert found.sharing == ("good", "as good")


def test_rivals_are_next_to_the_first_and_err_little_more():
    """One gap in which all but two fail leaves models of any error unseparated."""
    errors = {"one": [1, 1, 1, 1, 1], "near": [1, 2, 1, 2, 1], "far": [1, 1, 1, 1, 99]}
    found = ranking_of(errors)
    assert found.sharing == ("one", "near", "far")
    assert found.rivals == ("near",)
    behind = ranking_of({**errors, "near": [1.2, 1.3, 1.2, 1.3, 1.2], "last": [1, 1, 1, 1, 3]})
    assert "near" not in behind.sharing
    assert behind.rivals == ()


def test_a_constant_lead_separates_and_a_tie_does_not():
    errors = [1.0, 2.0, 3.0, 1.0, 2.0]
    found = ranking_of({"a": errors, "b": [error + 0.5 for error in errors], "c": errors})
    assert found.sharing == ("a", "c")


def test_a_lone_model_has_the_position_to_itself():
    assert ranking_of({"bad": ERRORS["bad"]}).sharing == ("bad",)


@pytest.mark.parametrize(("n_positions", "tested"), [(4, False), (5, True)])
def test_of_few_positions_nothing_is_told_however_many_held_out_gaps_there_are(n_positions, tested):
    positions = np.arange(40) % n_positions
    found = ranking_of({"a": np.ones(40), "b": 1.0 + positions % 2}, positions)
    assert (found.n_gaps, found.n_positions, found.tested) == (40, n_positions, tested)
    assert found.sharing == (("a", "b") if tested else ("a",))


def test_repeating_every_held_out_gap_at_its_position_changes_no_verdict():
    rng = np.random.default_rng(0)
    for lead in (0.1, 0.3, 0.5, 0.7):
        errors = {"good": rng.random(8), "behind": lead + rng.random(8), "bad": 3 + rng.random(8)}
        repeated = {model: np.repeat(each, 6) for model, each in errors.items()}
        found = ranking_of(repeated, np.repeat(np.arange(8), 6))
        assert found.sharing == ranking_of(errors).sharing


def test_positions_do_not_change_the_order():
    errors = {"one": [1.0, 1.0, 1.0, 9.0], "two": [2.0, 2.0, 2.0, 2.0]}
    assert ranking_of(errors, [0, 0, 0, 1]).order == ranking_of(errors).order == ("two", "one")


@given(st.lists(st.tuples(st.floats(0.1, 10.0), st.integers(1, 5)), min_size=1, max_size=6))
def test_a_held_out_gap_of_twice_the_weight_counts_as_two(gaps):
    errors, counts = map(np.array, zip(*gaps, strict=True))
    found = rank({"a": errors}, counts / counts.mean(), np.arange(len(gaps)))
    assert found.means["a"] == pytest.approx(np.repeat(errors, counts).mean())


@pytest.mark.parametrize("unit", [1e-3, 1e3])
def test_the_unit_of_errors_changes_no_verdict(unit):
    errors = {**ERRORS, "near": [1.4, 1.4, 1.3, 1.5, 1.4]}
    found = ranking_of(errors)
    other = ranking_of({model: unit * np.array(each) for model, each in errors.items()})
    for verdict in ("order", "sharing", "near", "rivals"):
        assert getattr(other, verdict) == getattr(found, verdict)
    for model, interval in found.intervals.items():
        assert other.intervals[model] == pytest.approx(np.multiply(interval, unit))


@given(st.lists(st.floats(0.0, 10.0), min_size=5, max_size=8))
def test_the_interval_of_a_mean_error_holds_it_and_nothing_below_0(errors):
    found = ranking_of({"a": errors})
    low, high = found.intervals["a"]
    assert 0.0 <= low <= found.means["a"] * (1 + 1e-12)
    assert found.means["a"] <= high * (1 + 1e-12)


def problem(n_frames, *gaps, rng=None):
    """Ask for frames of two channels of one random walk, with a little noise."""
    rng = np.random.default_rng(0) if rng is None else rng
    walk = np.cumsum(rng.normal(size=n_frames))[:, None]
    target = np.zeros((n_frames, 2), dtype=bool)
    for first, stop in gaps:
        target[first:stop] = True
    values = walk + rng.normal(0.0, 0.05, target.shape)
    times = np.arange(n_frames) / 30
    return GapProblem(Recording("r", times, values, ("a", "b"), ("mm",) * 2).hide(target), target)


def number(hold_outs):
    return number_positions(list_gaps(hold_outs))


def spans_of(hold_outs):
    """Return the frames of each held-out gap, as hold-outs hide them."""
    for hold_out in hold_outs:
        first = round(hold_out.problem.given.times[0] * 30)
        frames = first + np.nonzero(hold_out.problem.target)[0]
        for gap in hold_out.gaps:
            yield set(range(frames[gap.entries].min() - 1, frames[gap.entries].max() + 2))


GAPS = st.lists(st.tuples(st.integers(0, 190), st.integers(1, 60)), min_size=1, max_size=3)


@settings(deadline=None, max_examples=50)
@given(GAPS)
def test_a_position_is_a_held_out_gap_with_those_that_share_frames_with_it(gaps):
    hold_outs = make_hold_outs(
        problem(200, *((a, a + n) for a, n in gaps)), np.random.default_rng(0)
    )
    spans, positions = list(spans_of(hold_outs)), number(hold_outs)
    firsts = []
    for position in range(len(set(positions.tolist()))):
        here = [span for span, at in zip(spans, positions, strict=True) if at == position]
        firsts.append(min(here, key=max))
        assert all(firsts[-1] & span for span in here)
    assert sum(map(len, firsts)) == len(set().union(*firsts))


def test_held_out_gaps_of_a_short_recording_are_at_two_positions():
    hold_outs = make_hold_outs(problem(200, (70, 130)), np.random.default_rng(0))
    assert len(hold_outs) > 10
    assert set(number(hold_outs).tolist()) == {0, 1}


def test_held_out_gaps_of_a_long_recording_are_nearly_all_at_positions_of_their_own():
    hold_outs = make_hold_outs(problem(1500, (700, 715)), np.random.default_rng(0))
    positions = number(hold_outs)
    assert len(set(positions.tolist())) > 0.9 * len(positions) > 20


MEANS = st.lists(st.floats(0.1, 10.0), min_size=3, max_size=3)


@given(MEANS)
def test_a_kind_alone_keeps_its_order(means):
    own = ranking_of({model: [mean] for model, mean in zip("abc", means, strict=True)})
    assert share_evidence(own, [own]).order == own.order


def test_a_kind_of_few_gaps_follows_the_others_and_one_of_many_itself():
    few = ranking_of({"one": [1.0], "two": [1.1]})
    many = ranking_of({"one": [2.0, 1.9] * 20, "two": [1.0, 1.1] * 20})
    assert share_evidence(few, [few, many]).order == ("two", "one")
    assert share_evidence(many, [few, many]).order == ("two", "one")
    assert share_evidence(few, [few]).order == ("one", "two")


def test_a_model_that_is_worse_by_more_than_chance_comes_no_further_forward():
    own = ranking_of({"one": [1.0, 1.1, 1.0, 1.1, 1.0], "two": [1.3, 1.4, 1.3, 1.4, 1.3]})
    others = ranking_of({"one": [9.0, 9.1] * 50, "two": [1.0, 1.1] * 50})
    assert own.sharing == ("one",)
    assert share_evidence(own, [own, others]).order == ("one", "two")


@given(MEANS, MEANS)
def test_evidence_is_shared_by_the_closed_form(own, others):
    rankings = [
        ranking_of({m: [mean] * n for m, mean in zip("abc", means, strict=True)})
        for means, n in ((own, 1), (others, 3))
    ]
    logs = [np.log(means) - np.log(means).mean() for means in (own, others)]
    scores = (logs[0] + 5 * (logs[0] + 3 * logs[1]) / 4) / 6
    order = share_evidence(rankings[0], rankings).order
    found = [scores["abc".index(model)] for model in order]
    assert (np.diff(found) >= -1e-9).all()
