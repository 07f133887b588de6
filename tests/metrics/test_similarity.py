import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal import correlate

from mocapbench.metrics import Synthesis, mcc, mcc_best, mlc, mlc_best, variance_ratio
from mocapbench.metrics.correlation import cross_correlation

seeds = st.integers(0, 2**32 - 1)
CORRELATIONS = (mcc, mcc_best, mlc, mlc_best)


def outcome(seed, n_samples=3, n_references=2):
    rng = np.random.default_rng(seed)
    return Synthesis(rng.normal(size=(n_samples, 9, 4)), rng.normal(size=(n_references, 9, 4)))


def sine(phase, n=60):
    return np.sin(2 * np.pi * np.arange(n) / n + phase)[None, :, None]


@pytest.mark.parametrize("phase", [0.0, 0.5, 2.0, np.pi])
def test_mlc_of_shifted_sines_is_the_cosine_of_the_shift(phase):
    assert mlc(Synthesis(sine(phase), sine(0.0))).value == pytest.approx(np.cos(phase))


def test_mcc_of_a_sine_with_itself_is_its_energy_in_unit_range():
    # Σ (½ + ½ sin)² over a full period of N frames, extremes on the grid, is 3N/8
    assert mcc(Synthesis(sine(0.0), sine(0.0))).value == pytest.approx(3 * 60 / 8)


def test_mcc_finds_a_shifted_pulse_that_mlc_does_not():
    pulse, shifted = np.zeros((1, 20, 1)), np.zeros((1, 20, 1))
    pulse[0, 3:5], shifted[0, 14:16] = 1.0, 1.0
    assert mcc(Synthesis(shifted, pulse)).value == pytest.approx(2.0)
    assert mlc(Synthesis(shifted, pulse)).value < 0


@given(seed=seeds)
def test_cross_correlation_is_scipys_pair_by_pair(seed):
    drawn = outcome(seed)

    def scaled(y):
        return (y - y.min()) / (y.max() - y.min())

    expected = [
        [
            [correlate(scaled(s[:, d]), scaled(r[:, d]), "full", "direct").max() for d in range(4)]
            for r in drawn.references
        ]
        for s in drawn.samples
    ]
    np.testing.assert_allclose(cross_correlation(drawn), expected)


@given(seed=seeds)
def test_mlc_is_numpys_correlation_coefficient(seed):
    drawn = outcome(seed)
    expected = [
        [np.mean([np.corrcoef(s[:, d], r[:, d])[0, 1] for d in range(4)]) for r in drawn.references]
        for s in drawn.samples
    ]
    score = mlc(drawn)
    np.testing.assert_allclose(score.parts["sample"], np.mean(expected, axis=1))
    np.testing.assert_allclose(score.parts["reference"], np.mean(expected, axis=0))
    np.testing.assert_allclose(score.parts["reference_sd"], np.std(expected, axis=0, ddof=1))
    assert score.value == pytest.approx(np.mean(expected))


@given(seed=seeds, scale=st.floats(0.1, 10), offset=st.floats(-10, 10))
def test_correlations_are_invariant_to_the_unit_of_an_output(seed, scale, offset):
    drawn = outcome(seed)
    units = np.array([scale, 1.0, 1.0, 1.0])
    rescaled = Synthesis(drawn.samples * units + offset, drawn.references / units - offset)
    for metric in CORRELATIONS:
        assert metric(rescaled).value == pytest.approx(metric(drawn).value)


@given(seed=seeds, order=st.permutations(range(3)))
def test_the_order_of_samples_and_outputs_does_not_matter(seed, order):
    drawn = outcome(seed)
    permuted = Synthesis(drawn.samples[order][:, :, ::-1], drawn.references[:, :, ::-1])
    for metric in (*CORRELATIONS, variance_ratio):
        assert metric(permuted).value == pytest.approx(metric(drawn).value)


@given(seed=seeds)
def test_correlation_is_symmetric_in_samples_and_references(seed):
    drawn = outcome(seed)
    swapped = Synthesis(drawn.references, drawn.samples)
    for metric in (mcc, mlc):
        assert metric(swapped).value == pytest.approx(metric(drawn).value)


@given(seed=seeds)
def test_the_best_match_is_the_greatest_mean_over_samples(seed):
    drawn = outcome(seed, n_references=5)
    for mean, best in ((mcc, mcc_best), (mlc, mlc_best)):
        assert best(drawn).value == pytest.approx(mean(drawn).parts["reference"].max())
        assert best(drawn).parts["sample"].mean() == pytest.approx(best(drawn).value)


@pytest.mark.parametrize("where", ["samples", "references"])
@pytest.mark.parametrize("level", [7.0, np.where(np.arange(8) % 2, 0.3, np.nextafter(0.3, 1.0))])
def test_an_output_that_is_constant_anywhere_is_left_out_and_counted(where, level):
    drawn = outcome(0)
    flat = {"samples": drawn.samples.copy(), "references": drawn.references.copy()}
    flat[where][1, :, 2] = np.resize(level, flat[where].shape[1])
    kept = [0, 1, 3]
    without = Synthesis(drawn.samples[:, :, kept], drawn.references[:, :, kept])
    for metric in CORRELATIONS:
        score = metric(Synthesis(**flat))
        assert score.left_out == 1
        assert score.value == pytest.approx(metric(without).value)


def test_all_outputs_constant_is_not_a_number():
    for metric in CORRELATIONS:
        score = metric(Synthesis(np.ones((2, 5, 1)), np.ones((2, 5, 1))))
        assert np.isnan(score.value)
        assert score.left_out == 1


def test_a_single_sample_has_no_deviation():
    assert np.isnan(mlc(outcome(0, n_samples=1)).parts["reference_sd"]).all()


@given(seed=seeds, factor=st.floats(0.0, 10.0))
def test_the_variance_ratio_is_that_of_the_variances_around_the_mean(seed, factor):
    drawn = outcome(seed, n_samples=4)
    trend = drawn.samples.mean(axis=0)
    narrowed = Synthesis(trend + factor * (drawn.samples - trend), drawn.samples)
    assert variance_ratio(narrowed).value == pytest.approx(factor**2, abs=1e-12)


def test_the_variance_ratio_of_draws_from_one_process_is_one():
    rng = np.random.default_rng(4)
    drawn = Synthesis(rng.normal(size=(25, 100, 5)), rng.normal(size=(5, 100, 5)))
    assert variance_ratio(drawn).value == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    ("samples", "references", "message"),
    [
        (np.zeros((2, 5, 3)), np.zeros((2, 6, 3)), "equal"),
        (np.zeros((5, 3)), np.zeros((5, 3)), "equal"),
        (np.zeros((0, 5, 3)), np.zeros((2, 5, 3)), "at least one"),
        (np.full((2, 5, 3), np.nan), np.zeros((2, 5, 3)), "finite"),
    ],
)
@pytest.mark.parametrize("metric", [*CORRELATIONS, variance_ratio], ids=lambda metric: metric.name)
def test_unsound_outcomes_are_refused(metric, samples, references, message):
    with pytest.raises(ValueError, match=message):
        metric(Synthesis(samples, references))


@pytest.mark.parametrize(
    "metric", [mcc_best, mlc_best, variance_ratio], ids=lambda metric: metric.name
)
def test_one_reference_leaves_no_choice_and_no_variance(metric):
    assert np.isnan(metric(outcome(0, n_references=1)).value)
    assert np.isfinite(metric(outcome(0)).value)


def test_one_sample_has_no_variance_ratio():
    assert np.isnan(variance_ratio(outcome(0, n_samples=1)).value)


def test_the_variance_ratio_needs_references_that_differ():
    with pytest.raises(ValueError, match="differ"):
        variance_ratio(Synthesis(np.zeros((2, 5, 3)), np.ones((2, 5, 3))))
