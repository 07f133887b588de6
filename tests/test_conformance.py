"""One generic check per protocol, over everything registered."""

import inspect

import numpy as np
import pytest
from sklearn.base import clone

from mocapbench.baselines import (
    Aligner,
    Blender,
    Clusterer,
    Coregionalised,
    FrameImputer,
    Imputer,
    Inductive,
    Informed,
    Layered,
    Misinformed,
    Synthesiser,
    Trended,
)
from mocapbench.benchmark.plan import entrants
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.seeds import Seeds
from mocapbench.benchmark.solving import build_model
from mocapbench.datasets import Recording, ToyProcess, open_archive
from mocapbench.metrics import Clustering, Direction, Imputation, Recovery, Synthesis

TIMES = np.linspace(0.0, 2.0 * np.pi, 20)
PROCESS = ToyProcess.random(np.random.default_rng(5), n_outputs=2, noise=0.01)
OTHER_PROCESS = ToyProcess.random(np.random.default_rng(8), n_outputs=2, noise=0.01)
COMPLETE = PROCESS.draw(np.random.default_rng(6), TIMES, 4)
GAP = np.repeat(((np.arange(20) > 7) & (np.arange(20) < 12))[:, None], 2, axis=1)
SCATTERED = np.random.default_rng(7).random((20, 2)) < 0.5


def _names(ability):
    return [name for name in MODELS.names() if issubclass(MODELS.get(name), ability)]


def _tasks(*abilities):
    """Return the names of the tasks that require one of the abilities."""
    return [name for name in TASKS.names() if set(abilities) & set(TASKS.get(name).requires)]


def _problem(hidden):
    return (*COMPLETE[:-1], COMPLETE[-1].hide(hidden))


def _fitted(name, recordings, seed=0):
    model = build_model(name, {}, seed)
    budget = {"max_iter": 20, "n_restarts": 1}
    model.set_params(**{k: v for k, v in budget.items() if k in model.get_params()})
    if isinstance(model, Informed):
        model.inform(PROCESS)
    if isinstance(model, Misinformed):
        model.misinform(OTHER_PROCESS)
    return model.fit(recordings)


def _check_prediction(prediction, recording):
    hidden = ~recording.visible
    assert prediction.mean.shape == recording.values.shape
    assert np.isfinite(prediction.mean).all()
    np.testing.assert_array_equal(prediction.mean[~hidden], recording.values[~hidden])
    if prediction.variance is not None:
        assert (prediction.variance[hidden] > 0).all()
        assert (prediction.variance[~hidden] == 0).all()


@pytest.mark.parametrize("name", MODELS.names())
def test_the_constructor_only_stores(name):
    model = MODELS.get(name)()
    assert clone(model).get_params() == model.get_params()
    assert not [attribute for attribute in vars(model) if attribute.endswith("_")]
    assert inspect.getdoc(MODELS.get(name))


@pytest.mark.parametrize("name", MODELS.names())
def test_fit_changes_no_parameter_and_no_recording(name):
    recordings = _problem(GAP)
    before = [recording.values.copy() for recording in recordings]
    model = build_model(name, {}, 3)
    parameters = model.get_params()
    fitted = _fitted(name, recordings, 3)
    assert fitted.get_params().keys() == parameters.keys()
    for recording, values in zip(recordings, before, strict=True):
        np.testing.assert_array_equal(recording.values, values)


@pytest.mark.parametrize("name", _names(FrameImputer))
def test_whole_frames_are_filled(name):
    recordings = _problem(GAP)
    (prediction,) = _fitted(name, recordings).impute([recordings[-1]])
    _check_prediction(prediction, recordings[-1])


@pytest.mark.parametrize("name", _names(Imputer))
def test_any_mask_is_filled(name):
    recordings = _problem(SCATTERED)
    model = _fitted(name, recordings)
    for recording, prediction in zip(recordings, model.impute(recordings), strict=True):
        _check_prediction(prediction, recording)


@pytest.mark.parametrize("name", _names(FrameImputer))
def test_the_same_seed_gives_the_same_answer_and_global_state_is_left_alone(name):
    recordings = _problem(GAP)
    state = np.random.get_state()[1].copy()  # noqa: NPY002
    one, two = (_fitted(name, recordings).impute([recordings[-1]])[0].mean for _ in range(2))
    np.testing.assert_array_equal(one, two)
    assert (np.random.get_state()[1] == state).all()  # noqa: NPY002


@pytest.mark.parametrize("name", _names(FrameImputer))
def test_order_of_the_other_recordings_means_nothing(name):
    recordings = _problem(GAP)
    (one,) = _fitted(name, recordings).impute([recordings[-1]])
    (two,) = _fitted(name, (*recordings[2::-1], recordings[3])).impute([recordings[-1]])
    np.testing.assert_allclose(one.mean, two.mean, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("name", sorted(set(_names(FrameImputer)) & set(_names(Inductive))))
def test_an_inductive_model_fills_what_it_has_not_seen(name):
    new = Recording("new", TIMES, COMPLETE[-1].values, COMPLETE[-1].channels, COMPLETE[-1].units)
    (prediction,) = _fitted(name, COMPLETE[:-1]).impute([new.hide(GAP)])
    _check_prediction(prediction, new.hide(GAP))


@pytest.mark.parametrize("name", sorted(set(_names(FrameImputer)) - set(_names(Inductive))))
def test_another_model_refuses_what_it_has_not_seen(name):
    with pytest.raises(ValueError, match="child-4"):
        _fitted(name, COMPLETE[:-1]).impute([COMPLETE[-1].hide(GAP)])


@pytest.mark.parametrize("name", _names(Synthesiser))
def test_samples_are_seeded_and_shaped(name):
    model = _fitted(name, COMPLETE)
    one, two, other = (model.sample(TIMES, 3, seed) for seed in (1, 1, 2))
    assert one.shape == (3, 20, 2)
    assert np.isfinite(one).all()
    np.testing.assert_array_equal(one, two)
    assert not np.array_equal(one, other)


@pytest.mark.parametrize("name", _names(Clusterer))
def test_every_recording_has_a_cluster_and_the_same_seed_gives_the_same(name):
    one, two = (_fitted(name, _problem(GAP)).labels_ for _ in range(2))
    assert one.shape == (4,)
    assert np.issubdtype(one.dtype, np.integer)
    np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize("name", _names(Clusterer))
def test_one_style_is_one_cluster(name):
    model = build_model(name, {"n_styles": 1}, 0).fit(COMPLETE)
    assert len(set(model.labels_)) == 1


@pytest.mark.parametrize("name", _names(Aligner))
def test_every_frame_has_a_state_whether_fitted_or_aligned_later(name):
    recordings = _problem(GAP)
    model = _fitted(name, recordings)
    one, two = (model.align(recordings) for _ in range(2))
    for paths in (model.path_, one):
        assert [path.shape for path in paths] == [(20,)] * 4
        assert all(np.isin(path, np.arange(model.cycle_length_)).all() for path in paths)
    for path, again in zip(one, two, strict=True):
        np.testing.assert_array_equal(path, again)


@pytest.mark.parametrize("name", _names(Blender))
def test_a_blend_is_its_styles_mixed_frame_by_frame(name):
    model = build_model(name, {"n_styles": 3}, 0).fit(COMPLETE)
    weights = np.random.default_rng(0).dirichlet(np.ones(3), size=30)
    pure = [model.blend(np.tile(one, (30, 1))) for one in np.eye(3)]
    mixed = sum(share[:, None] * style for share, style in zip(weights.T, pure, strict=True))
    np.testing.assert_allclose(model.blend(weights), mixed, atol=1e-9)


@pytest.mark.parametrize("name", _names(Trended))
def test_a_trend_has_a_mean_and_a_variance_wherever_it_is_asked_for(name):
    mean, variance = _fitted(name, _problem(GAP)).trend(TIMES[::3] + 0.1)
    assert mean.shape == variance.shape == (7, 2)
    assert np.isfinite(mean).all()
    assert (variance > 0).all()


@pytest.mark.parametrize("name", _names(Layered))
def test_every_layer_has_a_covariance(name):
    model = _fitted(name, COMPLETE)
    assert model.layers
    for layer in model.layers:
        covariance = model.covariance(layer, TIMES)
        assert covariance.shape == (40, 40)
        np.testing.assert_allclose(covariance, covariance.T)
        assert np.linalg.eigvalsh(covariance).min() > -1e-6 * np.trace(covariance)


@pytest.mark.parametrize("name", _names(Coregionalised))
def test_coregionalisation_matrices_add_up_to_the_covariance_at_lag_0(name):
    model = _fitted(name, COMPLETE)
    assert set(model.coregionalisation_) == set(model.layers)
    for layer, matrices in model.coregionalisation_.items():
        assert matrices.ndim == 3
        at_one_time = model.covariance(layer, TIMES[:1])
        np.testing.assert_allclose(matrices.sum(axis=0), at_one_time, rtol=1e-9)


@pytest.mark.parametrize("name", TASKS.names())
def test_a_task_is_consistent(name):
    task = TASKS.get(name)
    cases = [case.name for case in task.cases]
    labels = [entrant.label for entrant in entrants(task)]
    assert task.name == name
    assert len(set(cases)) == len(cases)
    assert len(set(labels)) == len(labels)
    assert set(task.metrics) <= set(METRICS.names())
    assert set(task.published_models) <= set(labels)
    assert set(task.published_metrics) <= set(task.metrics)
    for selection in task.profiles.values():
        assert set(selection.cases) <= set(cases)
        assert selection.folds >= 1


def _posed(name, fold):
    """Return a problem of the task, of the first case whose recordings are at hand."""
    task, archive = TASKS.get(name), open_archive(None)
    case = next(c for c in task.cases if all(map(archive.available, c.sources)))
    return task.problem(case, Seeds(0, task.name, task.version, case.name, fold), archive)


@pytest.mark.parametrize("name", TASKS.names())
def test_a_problem_is_a_pure_function_of_its_address(name):
    one, two = (_posed(name, 1) for _ in range(2))
    assert one.train
    for a, b in zip(one.train, two.train, strict=True):
        assert a.name == b.name
        np.testing.assert_array_equal(a.values, b.values)


@pytest.mark.parametrize("name", _tasks(Imputer, FrameImputer))
def test_each_fold_hides_something_else_and_only_that(name):
    one, two, other = (_posed(name, fold) for fold in (1, 1, 2))
    for a, b in zip(one.given, two.given, strict=True):
        np.testing.assert_array_equal(a.values, b.values)
    assert not np.array_equal(one.given[0].values, other.given[0].values, equal_nan=True)
    for given, truth in zip(one.given, one.truth, strict=True):
        assert np.isnan(given.values).any()
        np.testing.assert_array_equal(truth[given.visible], given.values[given.visible])


OUTCOMES = {
    Imputation: Imputation(
        truth=COMPLETE[0].values,
        mean=COMPLETE[0].values + 0.1,
        variance=np.full((20, 2), 0.5),
        hidden=GAP,
        visible_mean=np.zeros(2),
        visible_variance=np.ones(2),
    ),
    Synthesis: Synthesis(
        np.stack([r.values for r in COMPLETE[:2]]), np.stack([r.values for r in COMPLETE[2:]])
    ),
    Recovery: Recovery(
        truth={"parent": 2.0 * np.eye(3), "child": np.eye(3)},
        estimate={"parent": np.eye(3), "child": 0.5 + np.eye(3)},
        noise=0.1,
    ),
    Clustering: Clustering(np.array(["walk", "walk", "run"]), np.array([0, 1, 1])),
}


@pytest.mark.parametrize("name", METRICS.names())
def test_a_metric_is_a_pure_finite_function(name):
    metric = METRICS.get(name)
    one, two = metric(OUTCOMES[metric.outcome]), metric(OUTCOMES[metric.outcome])
    assert metric.name == name
    assert np.isfinite(one.value)
    assert one.value == two.value
    assert (metric.target is not None) == (metric.direction is Direction.TARGET)
    assert inspect.getdoc(metric.statistic)


@pytest.mark.parametrize(
    "name", [n for n in METRICS.names() if METRICS.get(n).outcome is Imputation]
)
def test_a_metric_of_imputations_looks_at_hidden_entries_only(name):
    metric, outcome = METRICS.get(name), OUTCOMES[Imputation]
    elsewhere = Imputation(
        np.where(GAP, outcome.truth, 1e6),
        np.where(GAP, outcome.mean, -1e6),
        outcome.variance,
        outcome.hidden,
        outcome.visible_mean,
        outcome.visible_variance,
    )
    assert metric(elsewhere).value == metric(outcome).value
