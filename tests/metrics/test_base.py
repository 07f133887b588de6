import dataclasses
import functools
import pickle
from collections.abc import Mapping
from importlib.metadata import entry_points

import numpy as np
import pytest

from mocapbench.metrics import (
    Clustering,
    Direction,
    Imputation,
    Metric,
    Recovery,
    Score,
    Synthesis,
    has_poses,
    metric,
)
from mocapbench.metrics.horizons import HORIZONS

METRICS = [point.load() for point in entry_points(group="mocapbench.metrics")]
CONTINUED = {f"mpjpe_at_{frame}" for frame in HORIZONS}
OF_ROTATIONS = {"l2p", "l2q"}
SCORED = [metric for metric in METRICS if metric.name not in CONTINUED | OF_ROTATIONS]
"""Those of outcomes that need neither end with hidden frames nor be of rotations."""


def as_lists(value):
    """Return arrays, alone or in a mapping, as nested lists, and all else as it is."""
    if isinstance(value, Mapping):
        return {name: as_lists(item) for name, item in value.items()}
    return value.tolist() if isinstance(value, np.ndarray) else value


def test_names_are_distinct():
    names = [metric.name for metric in METRICS]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    ("direction", "target"),
    [(Direction.TARGET, None), (Direction.LOWER, 1.0), (Direction.HIGHER, 0.0)],
)
def test_targets_belong_to_targeted_metrics(direction, target):
    with pytest.raises(ValueError, match=f"expected a target.*got .*{target}; set the two"):
        dataclasses.replace(METRICS[0], direction=direction, target=target)


@pytest.mark.parametrize("metric", SCORED, ids=lambda metric: metric.name)
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


@pytest.mark.parametrize("metric", SCORED, ids=lambda metric: metric.name)
def test_metrics_can_be_sent_to_other_processes(metric, outcomes):
    outcome = outcomes[metric.outcome]
    assert pickle.loads(pickle.dumps(metric))(outcome).value == metric(outcome).value


@pytest.mark.parametrize("metric", [m for m in METRICS if m.needs_variance], ids=lambda m: m.name)
def test_metrics_of_distributions_need_a_variance(make, metric):
    with pytest.raises(ValueError, match="needs one"):
        metric(make([[1.0, 2.0]], 0.0, None))


@pytest.mark.parametrize(
    "metric", [m for m in SCORED if m.outcome is Imputation], ids=lambda m: m.name
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


@pytest.mark.parametrize("metric", SCORED, ids=lambda m: m.name)
def test_lists_count_as_arrays(metric, outcomes):
    outcome = outcomes[metric.outcome]
    lists = dataclasses.replace(outcome, **{n: as_lists(v) for n, v in vars(outcome).items()})
    assert metric(lists).value == metric(outcome).value


@pytest.mark.parametrize("metric", METRICS, ids=lambda m: m.name)
def test_other_outcomes_than_that_of_a_metric_are_refused(metric, outcomes):
    others = [other for kind, other in outcomes.items() if kind is not metric.outcome]
    for other in (None, "mse", *others):
        assert not metric.applies(other)
        expected = f"{metric.name}.*of class {metric.outcome.__name__}, got {type(other).__name__}"
        with pytest.raises(ValueError, match=expected):
            metric(other)


@pytest.mark.parametrize("metric", METRICS, ids=lambda m: m.name)
def test_a_metric_is_documented_as_its_function_is(metric):
    """`help` shows this, and doctest runs the examples."""
    function = getattr(metric.statistic, "func", metric.statistic)
    assert metric.__doc__ == function.__doc__
    assert metric.__module__ == function.__module__


def power_error(outcome: Synthesis, power):
    return Score(power * float(len(outcome.samples)))


def test_a_function_is_declared_under_its_own_name_for_the_outcome_of_its_annotation(outcomes):
    @metric(title="Count", direction=Direction.HIGHER, unit="samples")
    def count(outcome: Synthesis):
        return Score(float(len(outcome.samples)))

    assert isinstance(count, Metric)
    assert (count.name, count.outcome, count.unit) == ("count", Synthesis, "samples")
    assert count(outcomes[Synthesis]).value == 3.0
    assert not count.applies(outcomes[Imputation])


def test_a_formula_with_an_argument_makes_a_metric_for_each_value(outcomes):
    two, three = (
        metric(name=f"power_{power}", title="Power", direction=Direction.LOWER)(
            functools.partial(power_error, power=power)
        )
        for power in (2, 3)
    )
    assert (two.name, two.outcome, three.name) == ("power_2", Synthesis, "power_3")
    assert three(outcomes[Synthesis]).value == 1.5 * two(outcomes[Synthesis]).value


def nothing_said(outcome):
    return Score(0.0)


def unknown_kind(outcome: "Unknown"):  # noqa: F821 - the fault
    return Score(0.0)


def no_parameter():
    return Score(0.0)


@pytest.mark.parametrize(
    ("function", "got"),
    [(nothing_said, "none"), (no_parameter, "none"), (unknown_kind, ".*'Unknown' is not defined")],
)
def test_a_function_that_does_not_say_its_outcome_is_refused(function, got):
    expected = f"metric '{function.__name__}': expected the kind of outcome .* got {got}.*; write"
    with pytest.raises(ValueError, match=expected):
        metric(title="Mine", direction=Direction.LOWER)(function)
