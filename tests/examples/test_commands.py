"""The examples of models that are commands, each in the language that it shows."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import LinearImputer, PchipImputer
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.testing import check_model
from mocapbench.benchmark.testing.subject import COMPLETE, SCATTERED, problem

FOLDER = Path(__file__).parents[2] / "examples" / "commands"
PROGRAMS = {
    "neighbours": "python3",
    "lines": "Rscript",
    "pchip_gaps": "octave-cli",
    "gaussian": "octave-cli",
    "means": "julia",
}

pytestmark = pytest.mark.slow


@pytest.fixture
def build(monkeypatch):
    """Return a function that returns the class of an example, whose program must be here."""
    here = Path(sys.executable).parent  # with scikit-learn
    monkeypatch.setenv("PATH", f"{here}:/usr/bin:/bin")

    def build(name):
        if not shutil.which(PROGRAMS[name]):
            pytest.skip(f"{PROGRAMS[name]} is not installed")
        (model,) = load_plugin(FOLDER / f"{name}.toml")
        return MODELS.get(model)

    return build


@pytest.mark.parametrize("name", PROGRAMS)
def test_an_example_keeps_what_its_abilities_promise(build, name):
    check_model(build(name))


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.toml")), ids=lambda path: path.stem)
def test_every_example_is_tested(path):
    assert path.stem in PROGRAMS


@pytest.mark.parametrize(
    ("name", "ours"), [("lines", LinearImputer()), ("pchip_gaps", PchipImputer())]
)
def test_an_interpolation_elsewhere_is_ours(build, name, ours):
    recordings = problem(SCATTERED)
    (one,) = build(name)().fit(recordings).impute(recordings[-1:])
    (other,) = ours.fit(recordings).impute(recordings[-1:])
    np.testing.assert_allclose(one.mean, other.mean, rtol=1e-9, atol=1e-12)


def test_octave_predicts_as_a_gaussian_of_the_training_frames_does(build):
    (given,) = problem(SCATTERED)[-1:]
    (prediction,) = build("gaussian")().fit(COMPLETE[:-1]).impute([given])
    frames = np.concatenate([recording.values for recording in COMPLETE[:-1]])
    centre, covariance = frames.mean(axis=0), np.cov(frames.T) + 1e-6 * np.eye(2)
    one = np.flatnonzero(~given.visible[:, 0] & given.visible[:, 1])
    slope = covariance[0, 1] / covariance[1, 1]
    expected = centre[0] + slope * (given.values[one, 1] - centre[1])
    np.testing.assert_allclose(prediction.mean[one, 0], expected, rtol=1e-6)
    left = covariance[0, 0] - slope * covariance[0, 1]
    np.testing.assert_allclose(prediction.variance[one, 0], left, rtol=1e-6)
    none = ~given.visible.any(axis=1)
    np.testing.assert_allclose(prediction.mean[none], np.tile(centre, (none.sum(), 1)), rtol=1e-6)
