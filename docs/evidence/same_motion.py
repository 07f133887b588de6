"""The same motion in other circumstances, which `docs/results/people.md` reports.

::

    python docs/evidence/same_motion.py

prints, for each model and each change of a motion, the error in gaps of a second relative to that
in the motion as it is: over all people, and the largest of a person. Models learn from ten
recordings of strangers. The recording to fill alone is turned, moved and mirrored; all have the
other unit or frame rate. A spline tells what is between frames. Recordings are read from the
folders in the environment variable MOCAPBENCH_DATA. Ten minutes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np
from numpy.typing import NDArray
from parts import list_problems
from scipy.interpolate import CubicSpline, interp1d
from scipy.spatial.transform import Rotation

from mocapbench.baselines import ChannelKriging, FrameImputer, PoseKriging
from mocapbench.baselines.kriging.mirror_images import Image, mirror_image
from mocapbench.benchmark import ImputeProblem
from mocapbench.datasets import Recording

Array = NDArray[np.float64]
Change = Callable[[Recording], Recording]

MODELS: Mapping[str, tuple[type[FrameImputer], str]] = {
    "pose-kriging": (PoseKriging, "in-betweening"),
    "channel-kriging": (ChannelKriging, "lost-limb"),
}
"""And the task on which each is tried."""
RATE, AWAY = 30.0, (300.0, 0.0, -500.0)
"""Frames per second of the task, and how far motions are moved over the floor, in cm."""


def rotate_markers(recording: Recording, degrees: float) -> Recording:
    """Return markers that are turned about the vertical and moved."""
    about = Rotation.from_euler("y", degrees, degrees=True)
    turned = about.apply(recording.values.reshape(-1, 3).copy()) + AWAY
    return recording.with_values(turned.reshape(recording.values.shape))


def mirror_markers(recording: Recording) -> Recording:
    """Return markers whose left and right have changed places."""
    return cast("Image", mirror_image(recording.channels)).of_recording(recording)


def in_mm(recording: Recording) -> Recording:
    """Return markers in mm that were in cm."""
    units = tuple("mm" for _ in recording.units)
    return replace(recording, values=10.0 * recording.values, units=units)


def keep_recording(recording: Recording) -> Recording:
    """Return the recording as it is."""
    return recording


CHANGES: Mapping[str, tuple[Change, Change, float]] = {
    "as it is": (keep_recording, keep_recording, RATE),
    "turned by 90°, moved": (partial(rotate_markers, degrees=90.0), keep_recording, RATE),
    "turned by 180°, moved": (partial(rotate_markers, degrees=180.0), keep_recording, RATE),
    "mirrored": (mirror_markers, keep_recording, RATE),
    "mm": (in_mm, in_mm, RATE),
    **{f"{rate:g} Hz": (keep_recording, keep_recording, rate) for rate in (60.0, 100.0, 250.0)},
}
"""What is done to the recording to fill and to those learnt from, and the frame rate of both."""


def main() -> None:
    """Print a row for each model and each change."""
    for name, (model, task) in MODELS.items():
        people = list_problems(task, "1 s 10 strangers")
        before = np.ones(len(people))
        for change, how in CHANGES.items():
            errors = [[measure(model(), one, *how) for one in of] for of in people.values()]
            found = np.array([np.mean(of) for of in errors])
            before = found if change == "as it is" else before
            print(f"| `{name}` | {change} |", describe(found, before), "|", flush=True)


def describe(errors: Array, before: Array) -> str:
    """Return the error, relative to the one before, over people, and the largest of a person."""
    ratios = errors / before
    return f"{errors.mean():.2f} | {errors.mean() / before.mean():.3f} | {ratios.max():.3f}"


def measure(
    model: FrameImputer, problem: ImputeProblem, to_fill: Change, to_learn: Change, rate: float
) -> float:
    """Return the mean distance in cm of joints in hidden frames of the rate of the task."""
    (given,), (truth,) = problem.given, problem.truth
    asked, whole = to_fill(given), to_fill(given.with_values(truth))
    filled = hide_between(resample_recording(whole, rate), asked)
    training = [resample_recording(to_learn(one), rate) for one in problem.train]
    (prediction,) = model.fit(training).impute([filled])
    mean = CubicSpline(filled.times, prediction.mean)(whole.times)
    apart = np.linalg.norm((mean - whole.values).reshape(len(mean), -1, 3), axis=2)
    in_cm = {"cm": 1.0, "mm": 0.1}[whole.units[0]]
    return in_cm * float(apart[~asked.visible[:, ::3]].mean())


def resample_recording(recording: Recording, rate: float) -> Recording:
    """Return a complete recording at another rate, which begins and ends when it does."""
    if rate == RATE:
        return recording
    times = np.arange(int(recording.times[-1] * rate + 1e-9) + 1) / rate
    values = CubicSpline(recording.times, recording.values)(times)
    return Recording(recording.name, times, values, recording.channels, recording.units)


def hide_between(recording: Recording, given: Recording) -> Recording:
    """Return a recording that hides what is between visible entries of the one given."""
    # Between a hidden entry (1) and a visible one (0), a line is above 0 up to the visible one.
    shares = interp1d(given.times, (~given.visible).astype(float), axis=0)(recording.times)
    return recording.hide(shares > 1e-9)


if __name__ == "__main__":
    main()
