"""One estimator, whose fit and imputation can be followed in a few files."""

import inspect
import sys
from pathlib import Path

import numpy as np
import pytest

from mocapbench import baselines
from mocapbench.baselines import MOA, MOHGP, LMCIndependent, protocols
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.process import FittedProcess
from mocapbench.datasets import ToyProcess

BASELINES = Path(inspect.getfile(baselines)).resolve().parent
MOST_FILES, MOST_CLASSES = 5, 10


def own_classes(model):
    return [base for base in model.__mro__ if base.__module__.startswith("mocapbench.")]


@pytest.mark.parametrize("model", [MOHGP, MOA, LMCIndependent])
def test_a_model_is_one_estimator_with_abilities(model):
    """What it inherits besides are the interfaces of `protocols`, without code of the process."""
    own = own_classes(model)
    assert len(own) <= MOST_CLASSES
    estimators = [base for base in own if base.__module__ != protocols.__name__]
    assert estimators == [model, GaussianProcess]


def files_executed(function):
    """Return the files of which a call executes a function."""
    files = set()

    def note(frame, event, _):
        if event == "call":
            files.add(Path(frame.f_code.co_filename).resolve())

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        function()
    finally:
        sys.setprofile(before)
    return files


def problem():
    rng, times = np.random.default_rng(0), np.linspace(0.0, 5.0, 24)
    *complete, last = ToyProcess.random(rng, n_outputs=2, noise=0.02).draw(rng, times, 3)
    hidden = np.zeros(last.values.shape, dtype=bool)
    hidden[8:14] = True
    return [*complete, last.hide(hidden)]


def test_fit_and_impute_are_followed_in_five_files():
    """Beside what they stand on, each a folder of its own.

    These are the mathematics of the prior, the reduction, the solvers and the training, and what
    other models share: checks and units (`common`).
    """
    recordings, model = problem(), MOHGP(max_iter=2, registration="affine")
    files = files_executed(lambda: model.fit(recordings).impute(recordings))
    walked = {path for path in files if path.parent in (BASELINES, BASELINES / "gp")}
    assert BASELINES / "gp" / "estimator.py" in walked
    assert len(walked) <= MOST_FILES, sorted(walked)


def test_what_a_model_says_is_said_by_its_fitted_process():
    recordings = problem()
    model = MOHGP(max_iter=3).fit(recordings)
    process, times, given = model.process_, np.array([0.3, 0.1]), recordings[-1]
    assert isinstance(process, FittedProcess)
    replicate = process.reduction.replicates[[*model.recordings_].index(given.name)]
    (mean, variance), (trend, _) = process.infer(
        [replicate, process.reduction.trend], [given.times, times]
    )
    hidden = ~given.visible
    (posterior,) = model.impute([given])
    np.testing.assert_array_equal(posterior.mean[hidden], mean[hidden])
    np.testing.assert_array_equal(posterior.variance[hidden], (variance + process.noise)[hidden])
    np.testing.assert_array_equal(model.trend(times)[0], trend)
    np.testing.assert_array_equal(
        model.covariance("child", times), process.layer_covariance("child", times)
    )
    drawn = process.draw_recordings("mean", times, 2, np.random.default_rng(1))
    np.testing.assert_array_equal(model.sample(times, 2, 1), drawn)
