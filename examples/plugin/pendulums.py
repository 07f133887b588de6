"""A library of recordings, a model, a task and a metric in one file, for ``--plugin``."""

from functools import partial

import numpy as np

from mocapbench.baselines import FrameImputer, Inductive, Prediction
from mocapbench.benchmark import Case, ImputeProblem, Profile, Task, draw_gap_error, hide_frames
from mocapbench.datasets import Library, Recording
from mocapbench.metrics import Direction, Imputation, Score, metric
from mocapbench.reports import TaskPage

LENGTHS = {"short": 0.5, "middle": 1.0, "long": 2.0}
SOURCES = tuple(f"pendulums:{name}" for name in LENGTHS)
N_FRAMES, N_HIDDEN = 120, 20


class Pendulums(Library):
    """Swinging pendulums of three lengths; a library of yours may read files of `folders`."""

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
        before = np.concatenate([recording.values[:-1] for recording in recordings])
        after = np.concatenate([recording.values[1:] for recording in recordings])
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


def pendulum_problem(key, seeds, archive):
    """Hide twenty frames in a row of one pendulum, and give the others to learn from."""
    pendulums = dict(zip(LENGTHS, map(archive.recording, SOURCES), strict=True))
    held_out = pendulums.pop(key)
    start = int(seeds.generator("mask").integers(1, N_FRAMES - N_HIDDEN))
    hidden = hide_frames(start, start + N_HIDDEN, *held_out.values.shape)
    return ImputeProblem.of_one(held_out, hidden, tuple(pendulums.values()), seen_in_fit=False)


@metric(
    title="Worst error",
    direction=Direction.LOWER,
    sentence="Largest difference of prediction and truth over all hidden entries.",
    unit="that of the data",
)
def worst_error(outcome: Imputation):
    """Return the largest |y − μ| over all hidden entries, in the channels' own units."""
    return Score(float(np.abs(outcome.truth - outcome.mean)[outcome.hidden].max()))


PENDULUMS = Task(
    name="pendulums",
    version=1,
    requires={"fills frames", "fills new recordings"},
    cases=tuple(
        Case(key, partial(pendulum_problem, key), {"length, m": LENGTHS[key]}, SOURCES)
        for key in LENGTHS
    ),
    profiles={"quick": Profile(tuple(LENGTHS), folds=3)},
    page=TaskPage(
        title="Pendulums",
        reference="an example",
        description="Fill a gap in the swing of a pendulum, having seen others of other lengths.",
        metrics=("rms_per_frame", "worst_error"),
        illustrated=("long",),
        figures=(draw_gap_error,),
    ),
)

LIBRARIES = {"pendulums": Pendulums}
MODELS = {"linear-dynamics": LinearDynamics}
METRICS = {"worst_error": worst_error}
TASKS = {"pendulums": PENDULUMS}
