import numpy as np
import pytest

from mocapbench.benchmark.figures.sketches import sketch
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.problems.impute import ImputeProblem, Unit
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.registry import TASKS
from mocapbench.datasets import Recording, Skeleton

FILLING, CLUSTERING = TASKS.get("upper-body-missing"), TASKS.get("style-clustering")
TIMES = np.arange(6.0) / 30
HIDDEN = np.arange(6) >= 4


def _recording(name, seed, channels=FILLING.illustrated_channels):
    values = np.random.default_rng(seed).normal(size=(6, len(channels)))
    return Recording(name, TIMES, values, channels, ("deg",) * len(channels))


@pytest.fixture
def filling():
    whole = _recording("walk", 0)
    given = whole.hide(np.repeat(HIDDEN[:, None], 2, axis=1))
    return ImputeProblem((), None, (given,), (whole.values,), Unit.natural(2))


def _off(problem, by):
    return {"mean-0": np.where(problem.given[0].visible, problem.truth[0], problem.truth[0] + by)}


def test_the_papers_models_and_the_best_other_are_shown_where_entries_are_hidden(filling):
    errors = {"far": 9.0, "near": 1.0, "nn": 5.0}
    solutions = {label: _off(filling, by) for label, by in errors.items()}
    (illustration,) = sketch(filling, FILLING, solutions)
    assert illustration.groups == ("truth", "nn", "near")
    assert [panel.title for panel in illustration.panels] == list(FILLING.illustrated_channels)
    for column, panel in enumerate(illustration.panels):
        truth, nn, near = (curve.y for curve in panel.curves)
        np.testing.assert_array_equal(truth, filling.truth[0][:, column])
        np.testing.assert_array_equal(np.isnan(nn), ~HIDDEN)
        np.testing.assert_allclose(near[HIDDEN], truth[HIDDEN] + 1.0)


@pytest.fixture
def clustering():
    train = tuple(_recording(f"take {seed}", seed) for seed in range(3))
    return ClusterProblem(train, None, ("walk", "walk", "run"), Skeleton("nobody", 1.0, ()))


def test_each_model_that_aligns_has_a_panel_beside_the_recordings(clustering):
    labels = np.array([0, 0, 1])
    path = np.array([2, 3, 0, 2, 3, 1])
    paths = {f"path-{k}": path for k in range(3)}
    aligned = {"labels": labels, "cycle_length": np.array(4), **paths}
    solutions = {"groups only": {"labels": labels}, "aligner": aligned}
    (illustration,) = sketch(clustering, CLUSTERING, solutions)
    before, after = illustration.panels
    assert illustration.groups == ("walk", "run")
    assert after.title == "aligned by aligner"
    for one, other in zip(before.curves, after.curves, strict=True):
        np.testing.assert_allclose(one.x, TIMES)
        np.testing.assert_allclose(other.x, np.array([2, 3, 4, 6, 7, 9]) / 4)
        np.testing.assert_array_equal(one.y, other.y)


def test_the_curve_is_the_second_principal_component(clustering):
    frames = np.concatenate([recording.values for recording in clustering.train])
    centred = frames - frames.mean(axis=0)
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    (illustration,) = sketch(clustering, CLUSTERING, {})
    drawn = np.concatenate([curve.y for curve in illustration.panels[0].curves])
    np.testing.assert_allclose(np.abs(drawn), np.abs(centred @ axes[1]))


def test_other_kinds_have_no_figure_of_their_own():
    problem = SynthesiseProblem((), None, TIMES, 1, (np.zeros((6, 2)),))
    assert sketch(problem, FILLING, {}) == ()
