"""What each part of a model earns over many people, which `docs/results/people.md` reports.

::

    python docs/evidence/parts.py pose-kriging|channel-kriging

prints the error of the model in gaps of a second, then a row for each part that is left out or
changed: by how much the error is larger, with its 95 % interval over people, and the share of
hidden values that 95 % intervals hold. Models learn from recordings of the person, and of ten
strangers. Nothing was chosen by these figures. Recordings are read from the folders in the
environment variable MOCAPBENCH_DATA. Half an hour each.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from typing import Any
from unittest.mock import patch

import numpy as np
from imputation import load_problem
from numpy.typing import NDArray

from mocapbench.baselines import (
    ChannelKriging,
    FrameImputer,
    PoseKriging,
    channel_kriging,
    pose_kriging,
)
from mocapbench.baselines.kriging import channel_process, held_out_stretches, stacked, stances
from mocapbench.baselines.kriging.mirror_images import Image, find_symmetries
from mocapbench.benchmark import METRICS, TASKS, ImputeProblem
from mocapbench.datasets import Recording, RecordingUnavailable
from mocapbench.metrics.statistics import mean_interval

Array = NDArray[np.float64]

CASES = ("1 s own", "1 s 10 strangers")
MODULES = (pose_kriging, channel_kriging, channel_process, held_out_stretches, stacked, stances)
POSE, CHANNEL, PROCESS, LEARNING, STACKED, STANCES = (module.__name__ for module in MODULES)


def without(place: int) -> Array:
    """Return the medians of the priors, one of them so small that it counts for nothing."""
    typical = channel_process.TYPICAL
    return np.where(np.arange(len(typical)) == place, -12.0, typical)


def alike(values: Array, description: Array, channels: Array, others: Array) -> Array:
    """Return the same relevance for all channels."""
    del values, description, channels
    return np.ones(len(others))


def keep_first(one: object, other: object) -> object:
    """Return the first of two predictions."""
    del other
    return one


def take_best(errors: Array) -> Array:
    """Return weights of paths (K,), of which the one that errs least has all."""
    return np.asarray(np.arange(len(errors)) == errors.argmin(), dtype=float)


def keep_weights(weights: Array, products: Array) -> Array:
    """Return the weights of paths as they are."""
    del products
    return weights


def keep_itself(recordings: Sequence[Recording]) -> tuple[Image, ...]:
    """Return the motion itself, without its mirror image."""
    return find_symmetries(recordings)[:1]


Part = tuple[Mapping[str, Any], Mapping[str, object]]
"""Parameters of the model, and from the places of constants and functions to what stands there."""
PARTS: Mapping[str, tuple[str, type[FrameImputer], Mapping[str, Part]]] = {
    "pose-kriging": (
        "in-betweening",
        PoseKriging,
        {
            "own course over time alone": ({"least_explained": 1.0}, {}),
            "paths alone": ({}, {f"{POSE}._unite": keep_first}),
            "nearest path alone": ({}, {f"{POSE}.weigh_paths": take_best}),
            "weights by distance alone": ({}, {f"{POSE}.blend_paths": keep_weights}),
            "no mirror images": ({}, {f"{POSE}.find_symmetries": keep_itself}),
            "images, residuals of one side": ({"symmetry": 0.0}, {}),
            "not turned to face alike": ({}, {f"{STANCES}.FEWEST": np.inf}),
            "residuals over time alone": ({"pose_variance": 0.0}, {}),
            "one state a frame": ({"steps": 1}, {}),
            "no doubt about the path": ({}, {f"{POSE}.doubt_about_path": lambda *_: 0.0}),
            "variances as the process has them": (
                {},
                {f"{POSE}.growth_of_variance": lambda _: 1.0},
            ),
        },
    ),
    "channel-kriging": (
        "lost-limb",
        ChannelKriging,
        {
            "parameters as the priors have them": ({}, {f"{LEARNING}._STEPS": 0}),
            "all channels count alike": ({}, {f"{CHANNEL}.weigh_channels": alike}),
            "no linear part": ({}, {f"{PROCESS}.TYPICAL": without(1)}),
            "no part of a recording's own": ({}, {f"{PROCESS}.TYPICAL": without(2)}),
            "no drift over time": ({}, {f"{PROCESS}.TYPICAL": without(3)}),
            "that frame alone": ({}, {f"{STACKED}._BESIDE": np.array([0])}),
            "frames 4 before and after": ({}, {f"{STACKED}._BESIDE": np.array([-4, 0, 4])}),
            "not seen from the body": ({}, {f"{STANCES}.FEWEST": np.inf}),
            "300 frames of others": ({}, {f"{CHANNEL}._OTHERS": 300}),
            "3000 frames of others": ({}, {f"{CHANNEL}._OTHERS": 3000}),
        },
    ),
}


def main(name: str) -> None:
    """Print the table of a model."""
    task, model, parts = PARTS[name]
    cases = [list_problems(task, case) for case in CASES]
    whole = [score_people(model(), people) for people in cases]
    print_row("as it is", whole, [np.zeros(len(of)) for of in whole])
    for part, (parameters, places) in parts.items():
        with ExitStack() as stack:
            for place, instead in places.items():
                stack.enter_context(patch(place, instead))
            changed = [score_people(model(**parameters), people) for people in cases]
        print_row(part, changed, [of[:, 0] for of in whole])


def list_problems(task: str, name: str) -> Mapping[str, list[ImputeProblem]]:
    """Return the problems of each person of a case whose recordings are at hand."""
    problems = defaultdict(list)
    for fold, person in enumerate(TASKS.get(task).case(name).subjects):
        with suppress(RecordingUnavailable):
            problems[person].append(load_problem(task, name, fold))
    return problems


def score_people(model: FrameImputer, people: Mapping[str, list[ImputeProblem]]) -> Array:
    """Return the error in cm and the coverage of each person (P, 2)."""
    return np.array([np.mean([score(model, one) for one in of], axis=0) for of in people.values()])


def score(model: FrameImputer, problem: ImputeProblem) -> list[float]:
    """Return the error in cm and the coverage of a problem."""
    predictions = model.fit(problem.train).impute(problem.given)
    outcome = problem.outcome(tuple(predictions))
    return [METRICS.get(metric)(outcome).value for metric in ("mpjpe", "coverage_95")]


def print_row(part: str, scores: list[Array], before: list[Array]) -> None:
    """Print by how much errors are larger than before, and coverage, of each case."""
    cells = []
    for found, errors in zip(scores, before, strict=True):
        more = found[:, 0] - errors
        low, high = mean_interval(more)
        cells.append(f"{more.mean():.2f} ± {(high - low) / 2:.2f} ({found[:, 1].mean():.3f})")
    print(f"| {part} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
