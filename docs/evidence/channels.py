"""How well `channel-kriging` fills limbs, and what each of its parts earns.

An arm or a leg is hidden for a tenth of a second to two seconds, in joint angles without the root's
path, or in the positions of joints without its path on the floor; 30 frames a second, five seconds
at most; three other recordings of the subject are given, or none. Errors are root mean squared
errors in degrees and cm, of which the geometric mean over recordings and three draws is shown, and
the share that the model's 95 % intervals hold before calibration. Nothing was chosen on the
recordings of the second table. With `strangers` the recordings given are those of
thirty other people, and those to fill are of the people of `lost-limb`, none of which that task
tests. Ten to twenty minutes each:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/channels.py limbs|others|strangers
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import (
    ChannelKriging,
    CubicSplineImputer,
    MakimaImputer,
    Prediction,
    channel_kriging,
)
from mocapbench.baselines.kriging import channel_process, held_out_stretches, stacked
from mocapbench.baselines.kriging.channel_process import TYPICAL
from mocapbench.benchmark.tasks.marker_gaps import LIMBS
from mocapbench.datasets import (
    AcclaimFormat,
    Mask,
    Recording,
    joint_trajectories,
    read_people,
)

Array = NDArray[np.float64]

LIMBS_OF = {
    "09_02": ("09_01", "09_03", "09_04"),
    "08_05": ("08_01", "08_02", "08_03"),
    "39_04": ("39_01", "39_02", "39_03"),
    "64_05": ("64_06", "64_07", "64_08"),
    "02_03": ("02_01", "02_02", "02_04"),
    "10_01": ("10_02", "10_03", "10_05"),
    "16_21": ("16_05", "16_11", "16_03"),
    "12_01": (),
}
"""Recordings on which the model was chosen, and those to learn from."""
OTHERS_OF = {
    "07_05": ("07_01", "07_02", "07_04"),
    "35_18": ("35_01", "35_02", "35_17"),
    "39_10": ("39_12", "39_13", "39_14"),
    "64_18": ("64_16", "64_17", "64_19"),
    "02_08": ("02_07", "02_09", "02_10"),
    "16_52": ("16_50", "16_51", "16_53"),
    "16_37": ("16_36", "16_38", "16_45"),
    "09_12": ("09_09", "09_10", "09_11"),
    "64_28": ("64_26", "64_27", "64_29"),
    "11_01": (),
}
RATE, STEP, LONGEST = 30, 4, 600
SECONDS, DRAWS, N_STRANGERS = (0.1, 0.5, 1.0, 2.0), 3, 30

Change = Mapping[str, object]
"""From the places of constants and functions to what stands there instead."""


def without(place: int) -> Array:
    """Return the medians of the priors, one of them so small that it counts for nothing."""
    return np.where(np.arange(len(TYPICAL)) == place, -12.0, TYPICAL)


def alike(values: Array, windows: Array, channels: Array, others: Array) -> Array:
    """Return the same relevance for all channels."""
    del values, windows, channels
    return np.ones(len(others))


MODULES = (channel_process, held_out_stretches, stacked, channel_kriging)
PROCESS, LEARNING, STACKED, MODEL = (m.__name__ for m in MODULES)
CHANGES: Mapping[str, Change] = {
    "as it is": {},
    "parameters fixed at the medians": {f"{LEARNING}._STEPS": 0},
    "… and all channels count alike": {
        f"{LEARNING}._STEPS": 0,
        f"{MODEL}.weigh_channels": alike,
    },
    "all channels count alike": {f"{MODEL}.weigh_channels": alike},
    "no linear part": {f"{PROCESS}.TYPICAL": without(1)},
    "no part of a recording's own": {f"{PROCESS}.TYPICAL": without(2)},
    "no drift": {f"{PROCESS}.TYPICAL": without(3)},
    "100 frames to learn from": {f"{PROCESS}._LEARNT": 100},
    "frames −4 to 4": {f"{STACKED}._BESIDE": np.array([-4, -2, 0, 2, 4])},
    "that frame alone": {f"{STACKED}._BESIDE": np.array([0])},
    "ridge 0.1": {f"{STACKED}._RIDGE": 0.1},
}


NEAR: Mapping[str, Change] = {
    "as it is": {},
    **{f"{n} frames of others": {f"{MODEL}._OTHERS": n} for n in (300, 3000)},
}


@cache
def angles(name: str) -> Recording:
    """Return the joint angles of a recording, without where the root is."""
    recording = _read(name)
    return recording.select([name for name in recording.channels if not name.startswith("root.t")])


@cache
def joints(name: str) -> Recording:
    """Return the positions of joints, the root's path on the floor taken out."""
    recording = _read(name)
    on_the_spot = [name for name in recording.channels if name not in ("root.tx", "root.tz")]
    skeleton = AcclaimFormat().skeleton(_path(name))
    assert skeleton is not None
    return joint_trajectories(skeleton, recording.select(on_the_spot))


def _read(name: str) -> Recording:
    recording = AcclaimFormat().read(_path(name))
    return recording.frames(np.arange(0, min(len(recording.times), LONGEST), STEP))


def _path(name: str) -> Path:
    folder = Path(os.environ["MOCAPBENCH_DATA"].split(os.pathsep)[0])
    return folder / "subjects" / name.partition("_")[0] / f"{name}.amc"


KINDS = {"angles, deg": angles, "joints, cm": joints}


def gaps(
    groups: Mapping[str, Sequence[str]], kind: str, seconds: float
) -> Iterator[tuple[Recording, Mask, list[Recording]]]:
    """Yield a recording, what is hidden, and those to learn from; limbs and places are drawn."""
    for number, (name, others) in enumerate(groups.items()):
        recording, training = KINDS[kind](name), [KINDS[kind](other) for other in others]
        for draw in range(DRAWS):
            rng = np.random.default_rng([draw + 1, number])
            limb, place = str(rng.choice(list(LIMBS))), rng.random()
            length = round(RATE * seconds)
            start = 5 + int(place * (len(recording.times) - 10 - length))
            if start >= 5:
                columns = [c.partition(".")[0] in LIMBS[limb] for c in recording.channels]
                frames = np.arange(len(recording.times))
                inside = (frames >= start) & (frames < start + length)
                yield recording, np.outer(inside, columns), training


def error(recording: Recording, hidden: Mask, filled: Prediction) -> float:
    """Return the root mean squared error where values were hidden."""
    return float(np.sqrt(np.mean((filled.mean - recording.values)[hidden] ** 2)))


def held(recording: Recording, hidden: Mask, filled: Prediction) -> float:
    """Return the share of hidden entries in 95 % intervals."""
    assert filled.variance is not None
    within = np.abs(filled.mean - recording.values) <= 1.96 * np.sqrt(filled.variance)
    return float(within[hidden].mean())


def row(groups: Mapping[str, Sequence[str]], kind: str, change: Change) -> str:
    """Return errors, and in brackets what intervals hold, for each length of gaps."""
    cells = []
    with _changed(change):
        for seconds in SECONDS:
            found = []
            for recording, hidden, training in gaps(groups, kind, seconds):
                given = recording.hide(hidden)
                model = ChannelKriging().fit(training or [given])
                (filled,) = model.impute([given])
                found.append((error(recording, hidden, filled), held(recording, hidden, filled)))
            errors, shares = np.array(found).T
            cells.append(f"{np.exp(np.log(errors).mean()):.3g} ({shares.mean():.2f})")
    return " | ".join(cells)


def interpolated(groups: Mapping[str, Sequence[str]], kind: str, seconds: float) -> str:
    """Return the errors of two interpolations."""
    errors = []
    for recording, hidden, _ in gaps(groups, kind, seconds):
        given = recording.hide(hidden)
        filled = [
            m.fit([given]).impute([given])[0] for m in (MakimaImputer(), CubicSplineImputer())
        ]
        errors.append([error(recording, hidden, each) for each in filled])
    return " / ".join(f"{mean:.3g}" for mean in np.exp(np.log(errors).mean(axis=0)))


def _changed(change: Change) -> ExitStack:
    stack = ExitStack()
    for place, instead in change.items():
        stack.enter_context(patch(place, instead))
    return stack


def limbs() -> None:
    """Print what each part earns, on the recordings on which it was chosen."""
    for kind in KINDS:
        for name, change in CHANGES.items():
            print(f"| {kind} | {name} | {row(LIMBS_OF, kind, change)} |", flush=True)


def strangers() -> None:
    """Print how much depends on how many frames of strangers are learnt and predicted from."""
    people = read_people()
    tested = {
        own[-1]: subject for subject in people.subjects if len(own := people.own(subject)) > 1
    }
    groups = {
        _name(uri): [*map(_name, people.strangers(subject, N_STRANGERS))]
        for uri, subject in tested.items()
    }
    for kind in KINDS:
        for name, change in NEAR.items():
            print(f"| {kind} | {name} | {row(groups, kind, change)} |", flush=True)


def _name(uri: str) -> str:
    return uri.partition(":")[2]


def others() -> None:
    """Print errors on recordings on which nothing was chosen, beside those of interpolations."""
    before = "… and all channels count alike"
    for kind in KINDS:
        for name in ("as it is", before):
            print(f"| {kind} | {name} | {row(OTHERS_OF, kind, CHANGES[name])} |", flush=True)
        simple = " | ".join(interpolated(OTHERS_OF, kind, seconds) for seconds in SECONDS)
        print(f"| {kind} | `makima` / `cubic-spline` | {simple} |", flush=True)


if __name__ == "__main__":
    {"limbs": limbs, "others": others, "strangers": strangers}[sys.argv[1]]()
