"""A model, a task, a library of recordings and a metric in one file, for `mocapbench --plugin`."""

from functools import partial

import numpy as np

from mocapbench.baselines import FrameImputer, Inductive, Prediction
from mocapbench.benchmark import Case, GapError, ImputeProblem, Profile, Task, hide_frames
from mocapbench.datasets import Library, Recording
from mocapbench.metrics import Direction, Imputation, Metric, Score
from mocapbench.reports import TaskPage

LENGTHS = {"short": 0.5, "middle": 1.0, "long": 2.0}
N_FRAMES = 120
STEPS = (slice(None, -1), slice(1, None))


class Pendulums(Library):
    """Swinging pendulums of three lengths, in degrees; yours would read files of `data_dir`."""

    def where(self, key):
        return "generated" if key in LENGTHS else ""

    def recording(self, key):
        times = np.linspace(0.0, 4.0, N_FRAMES)
        angles = 20.0 * np.exp(-0.1 * times) * np.cos(times * np.sqrt(9.81 / LENGTHS[key]))
        values = np.column_stack([angles, np.gradient(angles, times)])
        return Recording(key, times, values, ("angle", "speed"), ("deg", "deg/s"))


class LinearDynamics(FrameImputer, Inductive):
    """Step through a gap by the linear map that best predicts each training frame from the last."""

    def fit(self, recordings):
        before, after = (np.concatenate([r.values[s] for r in recordings]) for s in STEPS)
        whole = np.isfinite(before + after).all(axis=1)
        self.map_ = np.linalg.lstsq(before[whole], after[whole], rcond=None)[0]
        return self

    def impute(self, recordings):
        return [Prediction.around(r, self._stepped(r.values.copy())) for r in recordings]

    def _stepped(self, values):
        for frame in range(1, len(values)):
            if np.isnan(values[frame]).any():
                values[frame] = values[frame - 1] @ self.map_
        return values


def pendulum_problem(key, n_hidden, seeds, archive):
    """Hide ``n_hidden`` frames in a row of one pendulum; the others are there to learn from."""
    pendulums = {name: archive.recording(f"pendulums:{name}") for name in LENGTHS}
    held_out = pendulums.pop(key)
    start = int(seeds.generator("mask").integers(1, N_FRAMES - n_hidden))
    hidden = hide_frames(start, start + n_hidden, *held_out.values.shape)
    return ImputeProblem.of_one(held_out, hidden, tuple(pendulums.values()), seen_in_fit=False)


def worst_error(outcome):
    """Return the largest |y − μ| over all hidden entries, in the channels' own units."""
    return Score(float(np.abs(outcome.truth - outcome.mean)[outcome.hidden].max()))


CASES = tuple(
    Case(
        f"{key}, {n_hidden} frames",
        partial(pendulum_problem, key, n_hidden),
        columns={"pendulum": key, "hidden frames": n_hidden},
        sources=tuple(f"pendulums:{name}" for name in LENGTHS),
    )
    for key in LENGTHS
    for n_hidden in (10, 30)
)
PAGE = TaskPage(
    title="Pendulums",
    reference="an example",
    description="Fill a gap in the swing of a pendulum, having seen others of other lengths.",
    metrics=("rms_per_frame", "worst_error"),
    illustrated=("long, 30 frames",),
    figures=(GapError(),),
)

WORST_ERROR = Metric("worst_error", "Worst error", Direction.LOWER, Imputation, worst_error)
PENDULUMS = Task(
    name="pendulums",
    version=1,
    page=PAGE,
    requires=(FrameImputer, Inductive),
    cases=CASES,
    profiles={"quick": Profile(tuple(case.name for case in CASES), folds=3)},
)

LIBRARIES = {"pendulums": Pendulums}
MODELS = {"linear-dynamics": LinearDynamics}
METRICS = {"worst_error": WORST_ERROR}
TASKS = {"pendulums": PENDULUMS}
