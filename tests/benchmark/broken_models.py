"""Models with one fault each, for the tests of the harness and of the conformance kit."""

import os
import resource
import subprocess
import sys
import time
import warnings

import numpy as np

from mocapbench.baselines import (
    Aligner,
    Blender,
    Imputer,
    Inductive,
    Interpolator,
    PCARegression,
    PoseViterbi,
    Prediction,
    Synthesiser,
)
from mocapbench.benchmark import METRICS
from mocapbench.metrics import Score


class _Mean(Imputer):
    """Fills every hidden entry with the mean of all visible ones."""

    def fit(self, recordings):
        values = np.concatenate([recording.values.ravel() for recording in recordings])
        self.mean_ = float(np.nanmean(values))
        return self

    def impute(self, recordings):
        return [Prediction.around(r, np.full(r.values.shape, self.mean_)) for r in recordings]


class Raises(_Mean):
    def fit(self, recordings):
        raise RuntimeError("the model <b>raised</b>")


class Quits(_Mean):
    def fit(self, recordings):
        sys.exit(0)


class Anything(_Mean):
    def __init__(self, **options):
        self.options = options


class Wordy(_Mean):
    def fit(self, recordings):
        raise ValueError("x" * 50_000)


class _SilentError(Exception):
    def __str__(self):
        raise RuntimeError("no message")


class Silent(_Mean):
    def fit(self, recordings):
        raise _SilentError


class Nameless(_Mean):
    family = ""


class Singular(_Mean):
    def fit(self, recordings):
        np.linalg.cholesky(np.zeros((2, 2)) - np.eye(2))


class NotANumber(_Mean):
    def impute(self, recordings):
        return [Prediction(np.full(r.values.shape, np.nan)) for r in recordings]


class Diverges(_Mean):
    """Answers with numbers whose squares overflow."""

    def impute(self, recordings):
        return [Prediction.around(r, np.full(r.values.shape, 1e300)) for r in recordings]


class WrongShape(_Mean):
    def impute(self, recordings):
        return [Prediction(np.zeros((2, 2))) for _ in recordings]


class WrongCount(_Mean):
    def impute(self, recordings):
        return []


class NoVariance(_Mean):
    def impute(self, recordings):
        return [Prediction(np.zeros(r.values.shape), np.zeros(r.values.shape)) for r in recordings]


class Spins(_Mean):
    def fit(self, recordings):
        while True:
            pass


class Hangs(_Mean):
    def fit(self, recordings):
        time.sleep(600)


class Exits(_Mean):
    def fit(self, recordings):
        raise SystemExit(5)


class Interrupts(_Mean):
    def fit(self, recordings):
        raise KeyboardInterrupt


class Arrays(_Mean):
    def impute(self, recordings):
        return [recording.values for recording in recordings]


class Unlocks(_Mean):
    def impute(self, recordings):
        recordings[0].values.setflags(write=True)


class Counts(_Mean):
    """Well-behaved, with counts that NumPy made."""

    def fit(self, recordings):
        self.n_iterations_, self.converged_ = np.int64(3), np.bool_(True)
        return super().fit(recordings)


class Dies(_Mean):
    def fit(self, recordings):
        os._exit(7)


class Meddles(_Mean):
    """Changes whatever the process shares, so that no other job would end as it should."""

    def fit(self, recordings):
        np.random.seed(1)  # noqa: NPY002
        np.seterr(all="raise")
        warnings.simplefilter("error")
        os.environ["OPENBLAS_NUM_THREADS"] = "7"
        os.chdir("/")
        resource.setrlimit(resource.RLIMIT_NOFILE, (16, 16))
        for name in ("mean", "nanmean", "concatenate"):
            setattr(np, name, None)
        Prediction.around = None
        raise RuntimeError("meddled")


class Rigs(_Mean):
    """Well-behaved, but for what scores it."""

    def impute(self, recordings):
        object.__setattr__(METRICS.get("mse"), "statistic", lambda outcome: Score(0.0))
        return super().impute(recordings)


class Litters(_Mean):
    """Leaves a process running."""

    def fit(self, recordings):
        subprocess.Popen(["sleep", "601"])
        return super().fit(recordings)


class Hungry(_Mean):
    def fit(self, recordings):
        self.hoard_ = np.ones(2**40)


MODELS = {
    "raises": Raises,
    "wordy": Wordy,
    "silent": Silent,
    "singular": Singular,
    "not-a-number": NotANumber,
    "diverges": Diverges,
    "wrong-shape": WrongShape,
    "wrong-count": WrongCount,
    "no-variance": NoVariance,
    "hangs": Hangs,
    "spins": Spins,
    "exits": Exits,
    "interrupts": Interrupts,
    "arrays": Arrays,
    "unlocks": Unlocks,
    "counts": Counts,
    "dies": Dies,
    "hungry": Hungry,
    "litters": Litters,
    "meddles": Meddles,
    "rigs": Rigs,
    "well-behaved": _Mean,
}


class Unconstructible(_Mean):
    """Needs an argument."""

    def __init__(self, size):
        self.size = size


class Eager(_Mean):
    """Learns in the constructor."""

    def __init__(self):
        self.mean_ = 0.0


class Converting(_Mean):
    """Stores something else than it is given."""

    def __init__(self, size=3):
        self.size = [size]


class Forgetful(_Mean):
    """Returns nothing from fit."""

    def fit(self, recordings):
        super().fit(recordings)


class Restless(_Mean):
    """Changes a parameter in fit."""

    def __init__(self, size=3):
        self.size = size

    def fit(self, recordings):
        self.size += 1
        return super().fit(recordings)


class Global(_Mean):
    """Seeds NumPy's global random state."""

    def fit(self, recordings):
        np.random.seed(0)  # noqa: NPY002
        return super().fit(recordings)


class Unseeded(_Mean):
    """Draws without a seed."""

    def impute(self, recordings):
        rng = np.random.default_rng()
        return [Prediction.around(r, rng.standard_normal(r.values.shape)) for r in recordings]


class Pretends(_Mean):
    """Has other means before calibration."""

    def impute_uncalibrated(self, recordings):
        return [Prediction.around(recording, -99.0) for recording in recordings]


class FirstOfNames(_Mean):
    """Learns from the recording whose name comes first."""

    def fit(self, recordings):
        return super().fit([min(recordings, key=lambda recording: recording.name)])


class FirstOnly(_Mean):
    """Learns from the first recording alone."""

    def fit(self, recordings):
        return super().fit(recordings[:1])


class Compass(PoseViterbi):
    """Matches poses as they face in the room."""

    provides = PoseViterbi.provides | {"turns along"}


class Surveyor(PCARegression):
    """Matches markers where they are in the room."""

    provides = PCARegression.provides | {"moves along"}


class RightHanded(PCARegression):
    """Knows one side of the body from the other."""

    provides = PCARegression.provides | {"mirrors along"}


class OneLength(_Mean):
    """Adds one, whatever the unit."""

    provides = _Mean.provides | {"scales along"}

    def impute(self, recordings):
        return [
            Prediction.around(r, p.mean + 1.0)
            for r, p in zip(recordings, super().impute(recordings), strict=True)
        ]


class OneRate(PoseViterbi):
    """Counts frames, whatever the time between two."""

    provides = PoseViterbi.provides | {"resamples along"}


class Overwrites(_Mean):
    """Puts its mean over what is visible."""

    def impute(self, recordings):
        return [Prediction(np.full(r.values.shape, self.mean_)) for r in recordings]


class VariesVisible(_Mean):
    """Is unsure of what is visible."""

    def impute(self, recordings):
        shapes = [r.values.shape for r in recordings]
        means = super().impute(recordings)
        return [Prediction(p.mean, np.ones(s)) for p, s in zip(means, shapes, strict=True)]


class FramesOnly(_Mean):
    """Fills whole frames and nothing else."""

    def impute(self, recordings):
        if any((r.visible.any(axis=1) != r.visible.all(axis=1)).any() for r in recordings):
            raise NotImplementedError("whole frames only")
        return super().impute(recordings)


class Stranger(_Mean, Inductive):
    """Says it takes new recordings, and does not."""

    def fit(self, recordings):
        self.names_ = [recording.name for recording in recordings]
        return super().fit(recordings)

    def impute(self, recordings):
        if any(recording.name not in self.names_ for recording in recordings):
            raise ValueError("never seen")
        return super().impute(recordings)


class MixesChannels(_Mean, Interpolator):
    pass


class _Sampler(_Mean, Synthesiser):
    """Samples noise."""

    def sample(self, times, n_samples, random_state):
        return np.random.default_rng(random_state).standard_normal((n_samples, len(times), 2))


class Transposed(_Sampler):
    """Samples channels by frames."""

    def sample(self, times, n_samples, random_state):
        return super().sample(times, n_samples, random_state).transpose(0, 2, 1)


class SameSamples(_Sampler):
    """Ignores the seed of its samples."""

    def sample(self, times, n_samples, random_state):
        return super().sample(times, n_samples, 0)


class _Styles(Blender, Aligner):
    """One style, one state."""

    cycle_length_ = 1

    def __init__(self, n_styles=2):
        self.n_styles = n_styles

    def fit(self, recordings):
        self.labels_ = np.zeros(len(recordings), dtype=int)
        self.path_ = tuple(self.align(recordings))
        return self

    def align(self, recordings):
        return [np.zeros(len(r.times), dtype=int) for r in recordings]

    def blend(self, weights):
        return np.zeros((len(weights), 2))


class Labels(_Styles):
    """Labels frames rather than recordings."""

    def fit(self, recordings):
        super().fit(recordings).labels_ = np.zeros(7)
        return self


class Divides(_Styles):
    """Finds more clusters than it may."""

    def fit(self, recordings):
        super().fit(recordings).labels_ = np.arange(len(recordings))
        return self


class Derails(_Styles):
    """Names a state that the cycle does not have."""

    def align(self, recordings):
        return [path + 5 for path in super().align(recordings)]


class Bends(_Styles):
    """Blends by the squares of the weights."""

    def blend(self, weights):
        return np.asarray(weights)[:, :2] ** 2


NONCONFORMING = {
    Nameless: "expected a family, such as 'Your models', got ''",
    Raises: "expected that .* got RuntimeError: the model <b>raised</b>",
    Quits: "expected that .* got SystemExit: 0",
    Anything: r"arguments of __init__ that have names and defaults, got \*\*options: name each",
    NotANumber: "expected a finite mean, got 40 NaN or infinite entries",
    WrongShape: r"expected a mean of shape \(20, 2\), got \(2, 2\)",
    WrongCount: r"expected impute to return a list of 1 Prediction, got \[\]",
    NoVariance: "visible entries copied into the mean",
    Arrays: r"expected impute to return a list of 1 Prediction, got \['ndarray'\]",
    Unconstructible: "constructor works without arguments .* TypeError",
    Eager: r"no learned state before fit, got \['mean_'\]",
    Converting: "does not set or modifies parameter size",
    Forgetful: "expected fit to return self, got None",
    Restless: "expected the parameters {'size': 3}, got {'size': 4}",
    Global: "expected NumPy's global random state untouched",
    Unseeded: "the same answer from the same seed",
    Pretends: "expected impute_uncalibrated to have the means of impute, got a difference of",
    FirstOnly: "recordings in another order, got a difference of",
    RightHanded: "the same fill of markers whose left and right have changed places, got markers",
    OneLength: "the same fill in mm and rad as in cm and deg.*leave out 'scales along'",
    OneRate: "the same fill of markers at 60 frames per second .*leave out 'resamples along'",
    Surveyor: "the same fill of markers that are turned by 90° and moved, got markers that differ",
    Compass: "the same fill of a walk that is turned by 90° and moved, got joints that differ",
    FirstOfNames: "recordings with other names, got a difference of",
    Overwrites: "visible entries copied into the mean",
    VariesVisible: "expected no variance at visible entries",
    FramesOnly: "hidden entries are filled wherever they are, got NotImplementedError",
    MixesChannels: "each channel filled as if it were alone",
    Stranger: "a recording that fit has not seen is filled.* got ValueError: never seen",
    Counts: "expected a ValueError that names child-4, which fit has not seen, got list",
    Transposed: r"expected samples of shape \(3, 20, 2\), got \(3, 2, 20\)",
    SameSamples: "expected other samples from another seed, got the same",
    Labels: r"expected labels_ of 4 integers, one a recording, got shape \(7,\) of float64",
    Divides: r"expected one cluster with n_styles=1, got \[0, 1, 2, 3\]",
    Derails: r"expected states 0 to 0, got \[5\]",
    Bends: "expected the weighted mean of the styles, got a difference of",
}
"""The fault that the conformance kit finds in each, as a regular expression."""
