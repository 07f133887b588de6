"""Folds that train on the same recordings share a fit, wherever and however often they run."""

import pytest

PLUGIN = """
from pathlib import Path
import numpy as np
from mocapbench.baselines import FrameImputer, Inductive, Prediction

class Drawn(FrameImputer, Inductive):
    def __init__(self, random_state=None):
        self.random_state = random_state

    def fit(self, recordings):
        self.level_ = np.random.default_rng(self.random_state).random()
        with Path({fits!r}).open("a") as file:
            file.write("fitted\\n")
        return self

    def impute(self, recordings):
        return [Prediction.around(recording, self.level_) for recording in recordings]

MODELS = {{"drawn": Drawn}}
"""
BACKENDS = [("--jobs", 1), ("--jobs", 2), ("--jobs", 4), ("--cluster", "local:2")]
COMPARED = ("scores", "parts", "key", "fit_key", "seed")


@pytest.fixture
def run(cli, records, tmp_path):
    """Return a function that runs twelve folds of two cases, and returns scores and fits."""
    fits, plugin = tmp_path / "fits", tmp_path / "drawn.py"
    plugin.write_text(PLUGIN.format(fits=str(fits)))
    request = (
        *("run", "--profile", "smoke", "--offline", "--tasks", "missing-frames"),
        *("--cases", "synthetic*", "--models", "drawn", "--plugin", plugin),
    )

    def run(name, *backend, folds=12):
        fits.write_text("")
        assert cli(*request, "--folds", folds, *backend, "--out", tmp_path / name) == 0, cli.printed
        found = {
            address: [record[name] for name in COMPARED]
            for address, record in records(tmp_path / name).items()
        }
        return found, fits.read_text().count("fitted")

    return run


@pytest.mark.slow
def test_scores_are_the_same_at_every_site_and_after_an_interruption(run):
    whole, n_fits = run("whole", *BACKENDS[0])
    assert len(whole) == 24
    assert n_fits == 1
    for number, backend in enumerate(BACKENDS[1:]):
        assert run(f"backend {number}", *backend) == (whole, 1)
    run("resumed", *BACKENDS[0], folds=5)
    assert run("resumed", *BACKENDS[1]) == (whole, 1)


@pytest.mark.slow
def test_predictions_that_are_there_do_not_stand_in_for_a_fit(run, tmp_path):
    """Of those only the record was lost."""
    whole, _ = run("whole", *BACKENDS[1])
    for path in sorted((tmp_path / "whole" / "records").rglob("*.json"))[:20]:
        path.unlink()
    for path in sorted((tmp_path / "whole" / "predictions").rglob("*.npz"))[:12]:
        path.unlink()
    again, n_fits = run("whole", *BACKENDS[1])
    assert again == whole
    assert n_fits == 1
