import dataclasses
import pickle
from importlib.metadata import entry_points

import numpy as np
import pytest

from mocapbench.metrics import Clustering, Direction, Imputation, Recovery, Synthesis, has_poses

METRICS = [point.load() for point in entry_points(group="mocapbench.metrics")]


@pytest.fixture
def outcomes(draw, place):
    rng = np.random.default_rng(0)
    synthesis = place(rng.normal(size=(3, 8, 3, 3)), rng.normal(size=(4, 8, 3, 3)))
    clustering = Clustering(rng.integers(3, size=9), rng.integers(4, size=9))
    recovery = Recovery(*(dict.fromkeys(("parent", "child"), c * np.eye(3)) for c in (1, 2)), 0.1)
    kinds = (Imputation, Synthesis, Clustering, Recovery)
    return dict(zip(kinds, (draw(0), synthesis, clustering, recovery), strict=True))


def test_names_are_distinct_and_targets_belong_to_targeted_metrics():
    names = [name for metric in METRICS for name in (metric.name, *metric.former_names)]
    assert len(set(names)) == len(names)
    for metric in METRICS:
        assert (metric.target is not None) == (metric.direction is Direction.TARGET)


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
def test_score_is_finite_and_parts_are_along_known_axes(metric, outcomes):
    score = metric(outcomes[metric.outcome])
    lengths = {
        Imputation: {"frame": 12, "output": 4, "joint": 3, "bin": 10},
        Synthesis: {"sample": 3, "reference": 4, "reference_sd": 4, "output": 9},
        Clustering: {},
        Recovery: {},
    }[metric.outcome]
    assert np.isfinite(score.value)
    assert {name: part.shape for name, part in score.parts.items()} == {
        name: (lengths[name],) for name in score.parts
    }


@pytest.mark.parametrize(
    "metric", [m for m in METRICS if m.defined is has_poses], ids=lambda m: m.name
)
def test_without_a_skeleton_metrics_of_joints_do_not_apply_and_say_so(metric, outcomes):
    bare = dataclasses.replace(outcomes[metric.outcome], place_joints=None)
    assert metric.applies(outcomes[metric.outcome])
    assert not metric.applies(bare)
    if metric.name != "sample_npss":  # which takes outputs as they are
        with pytest.raises(ValueError, match="expected an outcome with poses"):
            metric(bare)


def test_joints_are_placed_once_and_only_when_asked_for(draw):
    calls = []
    outcome = draw(0)

    def place():
        calls.append(1)
        return outcome.poses

    counted = dataclasses.replace(outcome, place_joints=place)
    for name, expected in (("mse", 0), ("mpjpe", 1), ("jerk_ratio", 1), ("foot_skate", 1)):
        next(metric for metric in METRICS if metric.name == name)(counted)
        assert len(calls) == expected


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
def test_metrics_can_be_sent_to_other_processes(metric, outcomes):
    outcome = outcomes[metric.outcome]
    assert pickle.loads(pickle.dumps(metric))(outcome).value == metric(outcome).value


@pytest.mark.parametrize("metric", [m for m in METRICS if m.needs_variance], ids=lambda m: m.name)
@pytest.mark.parametrize(
    ("variance", "message"),
    [(None, "needs one"), (0.0, "positive"), (-1.0, "positive"), (np.nan, "positive")],
)
def test_metrics_of_distributions_need_positive_variances(make, metric, variance, message):
    with pytest.raises(ValueError, match=message):
        metric(make([[1.0, 2.0]], 0.0, variance))


@pytest.mark.parametrize(
    "metric", [m for m in METRICS if m.outcome is Imputation], ids=lambda m: m.name
)
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"hidden": np.zeros((2, 2), dtype=bool)}, "at least one hidden entry"),
        ({"hidden": np.ones((2, 3), dtype=bool)}, "expected hidden of shape"),
        ({"visible_mean": np.zeros(3)}, "expected visible_mean of shape"),
        ({"truth": np.zeros((2, 2, 1))}, "truth of shape"),
        ({"truth": np.full((2, 2), np.nan)}, "finite truth"),
        ({"mean": np.inf}, "finite mean"),
    ],
)
def test_unsound_outcomes_are_refused(make, metric, changes, message):
    sound = {"truth": np.zeros((2, 2)), "mean": 0.0, "variance": 1.0}
    with pytest.raises(ValueError, match=message):
        metric(make(**(sound | changes)))


@pytest.mark.parametrize(
    "metric", [m for m in METRICS if m.outcome is Imputation], ids=lambda m: m.name
)
def test_visible_entries_do_not_count(draw, make, metric):
    outcome = draw(3)
    changed = make(
        np.where(outcome.hidden, outcome.truth, np.nan),
        np.where(outcome.hidden, outcome.mean, np.nan),
        outcome.variance,
        outcome.hidden,
        visible_mean=outcome.visible_mean,
        visible_variance=outcome.visible_variance,
    )
    assert metric(changed).value == metric(outcome).value


@pytest.mark.parametrize(
    "metric",
    [m for m in METRICS if m.outcome in (Imputation, Synthesis)],
    ids=lambda m: m.name,
)
def test_lists_count_as_arrays(metric, outcomes):
    outcome = outcomes[metric.outcome]
    arrays = {name: v for name, v in vars(outcome).items() if isinstance(v, np.ndarray)}
    lists = dataclasses.replace(outcome, **{name: v.tolist() for name, v in arrays.items()})
    assert metric(lists).value == metric(outcome).value


def test_a_mask_of_numbers_is_refused(make):
    """Zeros and ones would be taken as the numbers of frames."""
    with pytest.raises(ValueError, match=r"expected hidden to be True or False .* of int64"):
        make(np.zeros((2, 2)), 1.0, hidden=[[0, 1], [1, 0]])
