import dataclasses
import pickle
from collections.abc import Mapping
from importlib.metadata import entry_points

import numpy as np
import pytest

from mocapbench.metrics import Clustering, Imputation, Recovery, Synthesis, has_poses

METRICS = [point.load() for point in entry_points(group="mocapbench.metrics")]


def arrays_of(value):
    """Yield the arrays among the fields of an outcome, those of its poses and mappings included."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, Mapping) or hasattr(value, "__dict__"):
        fields = value if isinstance(value, Mapping) else vars(value)
        for item in fields.values():
            yield from arrays_of(item)


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


@pytest.mark.parametrize(
    ("kind", "n_arrays"), [(Imputation, 12), (Synthesis, 5), (Clustering, 2), (Recovery, 4)]
)
def test_what_metrics_share_cannot_be_written_to(outcomes, kind, n_arrays):
    outcome = outcomes[kind]
    if has_poses in [metric.defined for metric in METRICS if metric.outcome is kind]:
        assert outcome.poses
    arrays = [*arrays_of(outcome)]
    assert len(arrays) == n_arrays
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = array
    for name, field in vars(outcome).items():
        if isinstance(field, Mapping):
            with pytest.raises(TypeError):
                getattr(outcome, name)["parent"] = np.eye(3)


def test_who_made_an_array_may_still_write_to_it(make):
    truth = np.zeros((2, 2))
    outcome = make(truth, 1.0)
    truth[:] = 2.0
    assert (outcome.truth == 2.0).all()


@pytest.mark.parametrize("kind", [Imputation, Synthesis, Clustering, Recovery])
def test_outcomes_can_be_sent_to_other_processes(outcomes, kind):
    outcome = outcomes[kind]
    if kind in (Imputation, Synthesis):
        outcome = dataclasses.replace(outcome, place_joints=None)
    copy = pickle.loads(pickle.dumps(outcome))
    for one, two in zip(arrays_of(outcome), arrays_of(copy), strict=True):
        np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize(
    ("kind", "changes", "message"),
    [
        (Imputation, {"truth": "ab"}, "truth of Imputation to be real numbers"),
        (Imputation, {"mean": [[1j]]}, "mean of Imputation to be real numbers"),
        (Imputation, {"variance": [[1.0], [1.0, 2.0]]}, "variance of Imputation .* same length"),
        (Imputation, {"units": "degr"}, "units to be a sequence .*, got 'degr'"),
        (Imputation, {"units": None}, "units to be a sequence .*, got None"),
        (Imputation, {"units": ("deg", 1)}, "units to be a sequence .*, got "),
        (Synthesis, {"samples": "ab"}, "samples of Synthesis to be real numbers"),
        (Synthesis, {"references": [["a"]]}, "references of Synthesis to be real numbers"),
        (Clustering, {"labels": ["a"] * 9}, "labels to be the whole number of a cluster"),
        (Clustering, {"labels": None}, "labels to be the whole number of a cluster"),
        (Recovery, {"truth": np.eye(3)}, "truth to be a mapping of layers"),
        (Recovery, {"estimate": None}, "estimate to be a mapping of layers"),
        (Recovery, {"estimate": {"child": "ab"}}, "estimate of layer 'child' to be real numbers"),
        (Recovery, {"noise": "x"}, "noise to be a variance, got 'x'"),
    ],
)
def test_what_is_no_outcome_is_refused(outcomes, kind, changes, message):
    with pytest.raises(ValueError, match=f"expected {message}"):
        dataclasses.replace(outcomes[kind], **changes)


def test_a_mask_of_numbers_is_refused(make):
    """Zeros and ones would be taken as the numbers of frames."""
    with pytest.raises(ValueError, match=r"expected hidden to be True or False .* of int64"):
        make(np.zeros((2, 2)), 1.0, hidden=[[0, 1], [1, 0]])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"hidden": np.zeros((2, 2), dtype=bool)}, "at least one hidden entry"),
        ({"hidden": np.ones((2, 3), dtype=bool)}, "expected hidden of shape"),
        ({"visible_mean": np.zeros(3)}, "expected visible_mean of shape"),
        ({"visible_variance": np.zeros(3)}, "expected visible_variance of shape"),
        ({"truth": np.zeros((2, 2, 1))}, "truth of shape"),
        ({"truth": np.full((2, 2), np.nan)}, "finite truth"),
        ({"mean": np.inf}, "finite mean"),
        ({"variance": 0.0}, "positive, finite variances .* from 0 to 0"),
        ({"variance": -1.0}, "positive, finite variances .* from -1 to -1"),
        ({"variance": np.nan}, "positive, finite variances"),
        ({"variance": np.inf}, "positive, finite variances"),
        ({"units": ("deg",)}, "no units or one for each of 2 outputs"),
    ],
)
def test_an_unsound_imputation_is_refused(make, changes, message):
    sound = {"truth": np.zeros((2, 2)), "mean": 0.0, "variance": 1.0}
    assert make(**sound)
    with pytest.raises(ValueError, match=message):
        make(**(sound | changes))


def test_what_is_visible_needs_no_value(make):
    hidden = np.array([[True, False]])
    unknown = np.array([[1.0, np.nan]])
    assert make(unknown, unknown, unknown, hidden).hidden.sum() == 1
