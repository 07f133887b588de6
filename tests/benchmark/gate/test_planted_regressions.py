"""The gate bites: faults of the kinds that happen, planted, and the metric that must tell."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines import Imputer, Prediction
from mocapbench.baselines.gp.prior.kernels import RBF
from mocapbench.baselines.oracle import Oracle
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.problems.masks import hide_all_but
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.job import Work, WorkerConfig
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.plan_document import plan_document
from mocapbench.benchmark.runs.provenance import provenance
from mocapbench.benchmark.runs.request import Request
from mocapbench.benchmark.tasks import toy_interpolation

N_FOLDS = 20


class Draws(Imputer):
    """Fills with draws around the mean, from a seed of its own or, wrongly, from none."""

    seeded = True

    def __init__(self, random_state=0):
        self.random_state = random_state

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        rng = np.random.default_rng(self.random_state if self.seeded else None)
        return [Prediction.around(r, rng.standard_normal(r.values.shape)) for r in recordings]


@pytest.fixture
def run(tmp_path):
    """Return a function that runs smoke's toy task in this process, where faults are planted."""

    def run(name, model, n_folds=N_FOLDS):
        store = RunDirectory.create(tmp_path / name)
        about = {**provenance(["test"], threads=1), "profile": "smoke", "seed": "0"}
        unlimited = math.inf
        config = WorkerConfig((), (), 60.0, unlimited, 1, about)
        request = Request("smoke", ("toy-interpolation-1",), (model,), folds=n_folds)
        archive = archive_at()
        jobs = plan(request, archive)
        for job in jobs:
            record = evaluate(Work(job, None), config, archive).record
            assert not record.message
            store.save(record)
        store.save_plan(plan_document(jobs, provenance=about))
        return store.path

    return run


@pytest.fixture
def failing(cli, run, tmp_path):
    """Return a function from a model and a way to plant a fault to the metrics that fail."""

    def failing(model, plant, n_folds=N_FOLDS):
        before = run("before", model, n_folds)
        assert cli("check", run("again", model, n_folds), "--reference", before) == 0
        plant()
        after = run("after", model, n_folds)
        code = cli("check", after, "--reference", before)
        found = json.loads((after / "check.json").read_text())["findings"]
        metrics = {each["metric"] for each in found if each["fails"]}
        assert (code == 1) is bool(metrics)
        assert all(metric in cli.printed for metric in metrics)
        return metrics

    return failing


def test_a_kernel_with_a_wrong_factor(failing, monkeypatch):
    """exp(−d²/ℓ²) instead of exp(−d²/2ℓ²), in a model that cannot learn it away."""

    right = Oracle.fit

    def fit(self, recordings, process):
        layers = {
            name: replace(layer, lengthscales=layer.lengthscales / np.sqrt(2.0))
            for name, layer in (("parent", process.parent), ("child", process.child))
        }
        return right(self, recordings, replace(process, **layers))

    failed = failing("oracle", lambda: monkeypatch.setattr(Oracle, "fit", fit))
    assert {"mse", "smse_pooled", "msll", "crps"} <= failed


def test_a_gradient_with_a_wrong_factor(failing, monkeypatch):
    """The search of a model that learns ends elsewhere; libraries decide what pays for it."""
    right = RBF.gradient

    def gradient(self, lags, lengthscale):
        return 0.1 * right(self, lags, lengthscale)

    plant = lambda: monkeypatch.setattr(RBF, "gradient", gradient)  # noqa: E731
    assert failing("gp-independent", plant, n_folds=2)


def test_a_mask_off_by_one(failing, monkeypatch):
    def off_by_one(rng, n_visible, n_frames, n_channels):
        return hide_all_but(rng, n_visible - 1, n_frames, n_channels)

    plant = lambda: monkeypatch.setattr(toy_interpolation, "hide_all_but", off_by_one)  # noqa: E731
    assert {"mse", "smse_pooled"} <= failing("cubic-spline", plant)


def test_a_noise_variance_dropped_from_the_likelihood(failing, monkeypatch):
    right = Oracle._conditional

    def without_noise(self, p, row, hidden):
        mean, variance = right(self, p, row, hidden)
        return mean, variance - 0.9 * self.process_.noise

    failed = failing("oracle", lambda: monkeypatch.setattr(Oracle, "_conditional", without_noise))
    assert "msll" in failed
    assert not failed & {"mse", "smse", "smse_pooled", "rms_per_frame"}


def test_an_unseeded_draw(failing, monkeypatch):
    """None of twenty folds gets worse by chance once in a million runs."""
    MODELS.add("draws", Draws)
    assert "mse" in failing("draws", lambda: monkeypatch.setattr(Draws, "seeded", False))
