"""Laws that every simple model keeps."""

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.exceptions import NotFittedError

from mocapbench.baselines import Imputer, Inductive, Model
from mocapbench.baselines.aligned_window import AlignedWindow
from mocapbench.baselines.interpolation import (
    CubicSplineImputer,
    HoldImputer,
    LinearImputer,
    MakimaImputer,
    PchipImputer,
)
from mocapbench.baselines.knn import KNN
from mocapbench.baselines.low_rank import LowRank
from mocapbench.baselines.nn import NN
from mocapbench.baselines.oracle import Oracle
from mocapbench.baselines.pca_regression import PCARegression
from mocapbench.baselines.trivial import Trivial
from mocapbench.datasets import ToyProcess

TIMES = np.linspace(0.0, 2 * np.pi, 25)
MODELS = (
    Trivial(),
    HoldImputer(),
    LinearImputer(),
    PchipImputer(),
    MakimaImputer(),
    CubicSplineImputer(),
    KNN(n_neighbors=4),
    NN(),
    PCARegression(),
    LowRank(),
    AlignedWindow(n_windows=3),
    Oracle(),
)


def models_that_are(ability):
    chosen = [model for model in MODELS if ability.provides <= model.provides]
    return pytest.mark.parametrize("model", chosen, ids=lambda model: type(model).__name__)


every_model = models_that_are(Model)
imputers = models_that_are(Imputer)
inductive = models_that_are(Inductive)


def process():
    return ToyProcess.random(np.random.default_rng(5), n_outputs=3, noise=0.01)


def fit_anew(model, recordings):
    """Return a copy of a model, fitted, with the process if it needs that."""
    given = {"process": process()} if "true process" in model.needs else {}
    return clone(model).fit(recordings, **given)


@pytest.fixture
def recordings():
    """Five children; two gaps of whole frames in the last."""
    children = process().draw(np.random.default_rng(6), TIMES, 5)
    frames = np.arange(len(TIMES))
    gaps = ((frames > 4) & (frames < 9)) | (frames > 20)
    return [*children[:-1], children[-1].hide(np.repeat(gaps[:, None], 3, axis=1))]


@pytest.fixture
def scattered(recordings):
    """The same with scattered hidden entries in the last but one."""
    hidden = np.random.default_rng(7).random((len(TIMES), 3)) < 0.4
    return [*recordings[:3], recordings[3].hide(hidden), recordings[4]]


@every_model
def test_visible_entries_are_copied_and_certain(model, recordings):
    for recording, prediction in zip(
        recordings, fit_anew(model, recordings).impute(recordings), strict=True
    ):
        seen = recording.visible
        np.testing.assert_array_equal(prediction.mean[seen], recording.values[seen])
        assert np.isfinite(prediction.mean).all()
        if prediction.variance is not None:
            assert (prediction.variance[seen] == 0).all()
            assert (prediction.variance[~seen] > 0).all()


@imputers
def test_imputers_fill_any_mask(model, scattered):
    for recording, prediction in zip(
        scattered, fit_anew(model, scattered).impute(scattered), strict=True
    ):
        assert np.isfinite(prediction.mean).all()
        np.testing.assert_array_equal(
            prediction.mean[recording.visible], recording.values[recording.visible]
        )


@every_model
def test_the_order_of_recordings_does_not_matter(model, recordings):
    target = recordings[-1:]
    forward = fit_anew(model, recordings).impute(target)[0]
    backward = fit_anew(model, recordings[::-1]).impute(target)[0]
    np.testing.assert_allclose(forward.mean, backward.mean, atol=1e-10)


@inductive
def test_the_order_of_channels_does_not_matter(model, recordings):
    order = recordings[0].channels[::-1]
    target = [recordings[-1].select(order)]
    mirrored = fit_anew(model, [r.select(order) for r in recordings]).impute(target)[0]
    straight = fit_anew(model, recordings).impute(recordings[-1:])[0]
    np.testing.assert_allclose(mirrored.mean[:, ::-1], straight.mean, atol=1e-10)


@every_model
def test_fit_changes_neither_parameters_nor_later_fits(model, recordings):
    before = model.get_params()
    fitted = fit_anew(model, recordings)
    first = fitted.impute(recordings[-1:])[0].mean
    assert fitted.get_params() == before == clone(fitted).get_params()
    again = fit_anew(fitted, recordings)
    np.testing.assert_array_equal(again.impute(recordings[-1:])[0].mean, first)


@every_model
def test_what_fit_refuses(model, recordings):
    with pytest.raises(ValueError, match="at least one recording"):
        fit_anew(model, [])
    with pytest.raises(ValueError, match="distinct names"):
        fit_anew(model, [recordings[0], recordings[0]])
    with pytest.raises(ValueError, match="expected channels"):
        fit_anew(model, [recordings[0], recordings[1].select(recordings[1].channels[:2])])


@every_model
def test_impute_waits_for_fit(model, recordings):
    with pytest.raises(NotFittedError):
        clone(model).impute(recordings)


@inductive
def test_inductive_models_fill_new_recordings(model, recordings):
    fitted = fit_anew(model, recordings[:-1])
    alone = fitted.impute(recordings[-1:])[0].mean
    assert np.isfinite(alone).all()
    np.testing.assert_array_equal(fitted.impute(recordings)[-1].mean, alone)
    with pytest.raises(ValueError, match="expected channels"):
        fitted.impute([recordings[-1].select(recordings[-1].channels[:2])])
