import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import cumulative_scaled_error, rms_angle

METRICS = [rms_angle, cumulative_scaled_error]
seeds = st.integers(0, 2**32 - 1)


def scaled(outcome, scales):
    return dataclasses.replace(outcome, scales=np.asarray(scales, dtype=float))


def test_two_frames_of_two_angles_by_hand(make):
    outcome = scaled(make([[1.0, 2.0], [3.0, 6.0]], [[1.0, 4.0], [2.0, 5.0]]), [0.5, 2.0])
    # squared errors [[0, 4], [1, 1]], times squared scales [[0, 16], [0.25, 4]]
    assert rms_angle(outcome).value == pytest.approx(np.sqrt(1.5))
    assert cumulative_scaled_error(outcome).value == pytest.approx((0.25 + 20.0) / 2)
    np.testing.assert_allclose(cumulative_scaled_error(outcome).parts["output"], [0.25, 20.0])


@given(seed=seeds)
def test_the_cumulative_error_is_the_mean_of_its_outputs(draw, seed):
    score = cumulative_scaled_error(scaled(draw(seed), [1.0, np.nan, 3.0, 4.0]))
    assert score.value == pytest.approx(np.nanmean(score.parts["output"]))
    assert np.isnan(score.parts["output"]).tolist() == [False, True, False, False]


@given(seed=seeds, factor=st.floats(0.1, 10.0))
def test_errors_grow_with_the_unit_and_only_one_with_the_scales(draw, seed, factor):
    outcome = scaled(draw(seed), [1.0, 2.0, 3.0, 4.0])
    larger = dataclasses.replace(outcome, truth=factor * outcome.truth, mean=factor * outcome.mean)
    stretched = scaled(outcome, factor * outcome.scales)
    one, error = rms_angle(outcome).value, cumulative_scaled_error(outcome).value
    assert rms_angle(larger).value == pytest.approx(factor * one)
    assert rms_angle(stretched).value == one
    assert cumulative_scaled_error(larger).value == pytest.approx(factor**2 * error)
    assert cumulative_scaled_error(stretched).value == pytest.approx(factor**2 * error)


@pytest.mark.parametrize("metric", METRICS)
@given(seed=seeds)
def test_outputs_without_a_scale_do_not_count(metric, draw, seed):
    outcome = scaled(draw(seed), [1.0, 2.0, np.nan, 4.0])
    other = dataclasses.replace(outcome, mean=outcome.mean + 1e6 * (np.arange(4) == 2))
    assert metric(outcome).value == metric(other).value


@pytest.mark.parametrize("metric", METRICS)
def test_a_task_without_scales_has_no_such_errors(metric, make):
    outcome = dataclasses.replace(make([[1.0]], [[2.0]]), scales=None)
    assert not metric.applies(outcome)
    assert metric.applies(scaled(outcome, [1.0]))
    with pytest.raises(ValueError, match="expected scales of the joint angles, got None"):
        metric(outcome)


@pytest.mark.parametrize("metric", METRICS)
def test_scales_of_other_outputs_are_refused(metric, make):
    with pytest.raises(ValueError, match=r"expected scales of shape \(1,\)"):
        metric(scaled(make([[1.0]], [[2.0]]), [1.0, 2.0]))


@pytest.mark.parametrize("metric", METRICS)
def test_where_no_angle_is_hidden_there_is_no_error(metric, make):
    hidden = np.array([[True, False]])
    outcome = make([[1.0, 2.0]], [[2.0, 2.0]], hidden=hidden)
    assert np.isnan(metric(scaled(outcome, [np.nan, 1.0])).value)
