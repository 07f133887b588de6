"""Figures that `docs/results/published.md` reports.

::

    python docs/evidence/imputation.py tasks   # both on the tasks themselves, with seconds
    python docs/evidence/imputation.py frames  # channel-kriging, its learning frames drawn anew
    python docs/evidence/imputation.py headings # pose-kriging, the tests' motion turned about
    python docs/evidence/imputation.py others  # pose-kriging, walks of people who are not in it
    python docs/evidence/imputation.py many    # pose-kriging, taught by all walks, or by strangers

All use tests, those of `missing-frames` and `subject-35-missing` or walks of people who are in no
training, which choose nothing.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from operator import eq
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from mocapbench import benchmark as bench
from mocapbench.baselines import ChannelKriging, FrameImputer, MakimaImputer, PoseKriging
from mocapbench.baselines.kriging import described_frames
from mocapbench.benchmark import METRICS, TASKS, Address, ImputeProblem, Seeds
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.tasks.missing_frames import (
    N_TEST_FRAMES,
    N_WINDOWS,
    TESTS,
    TRAINING,
    hide_window,
)
from mocapbench.benchmark.testing.facing import rotate_motion
from mocapbench.datasets import (
    Recording,
    RecordingUnavailable,
    gpdm_features,
    read_people,
    subject_of,
)
from mocapbench.metrics import Imputation
from mocapbench.metrics.statistics import mean_interval

Array = NDArray[np.float64]

SIX = ("35_03", "16_21", "07_01", "07_02", "08_01", "08_02")
"""The rows of the task, six of eight, over which the page has means."""


def _outcome(problem: ImputeProblem, model: FrameImputer) -> Imputation:
    return problem.outcome(tuple(model.impute(problem.given)))


def tasks() -> None:
    """Print the scores of both models on the tasks, and seconds of this process."""
    for task, model, names, n_folds in (
        ("missing-frames", PoseKriging, ("rms_per_frame", "mpjpe"), 12),
        ("golf-swings", PoseKriging, ("rms_per_frame", "mpjpe"), 8),
        ("subject-35-missing", ChannelKriging, ("rms_angle", "cumulative_scaled_error"), 1),
    ):
        for case in TASKS.get(task).cases:
            if not case.synthetic and "four-walkers" not in case.name:
                _score(task, case.name, model(), names, n_folds)


def _score(task: str, case: str, model: FrameImputer, names: Sequence[str], n_folds: int) -> None:
    try:
        problems = [load_problem(task, case, fold) for fold in range(n_folds)]
    except RecordingUnavailable:
        return
    began = time.process_time()
    means = _mean_scores(model, problems, *names, "coverage_95")
    seconds = (time.process_time() - began) / n_folds
    print(f"{task:20} {case:24} {np.round(means, 3)} {seconds:.2f} s", flush=True)


def load_problem(task: str, case: str, fold: int) -> ImputeProblem:
    """Return the problem of a fold of a case."""
    found = TASKS.get(task).case(case)
    address = Address(task, TASKS.get(task).version, found.problem_name, fold)
    problem = found.problem(Seeds(0, address), bench.archive_at())
    assert isinstance(problem, ImputeProblem)
    return problem


def frames() -> None:
    """Print the errors of `ChannelKriging` with eight other choices of its learning frames."""
    for part in ("right leg", "upper body"):
        problem = load_problem("subject-35-missing", part, 0)
        rows = []
        for seed in range(8):
            shift = np.random.default_rng(seed)
            with patch.object(described_frames, "_spread", partial(_spread_anew, shift)):
                outcome = _outcome(problem, ChannelKriging().fit(problem.train))
            names = ("rms_angle", "cumulative_scaled_error")
            rows.append([METRICS.get(name)(outcome).value for name in names])
        each = [np.round(of(rows, axis=0), 3) for of in (np.mean, np.min, np.max)]
        print(part, "mean, least and most:", *each, flush=True)


def _spread_anew(shift: np.random.Generator, places: Array, number: int) -> Array:
    """Return so many places in a row, each as far from the next, from a random one on."""
    chosen = ((np.arange(number) + shift.random()) * len(places) / number).astype(int)
    return np.asarray(places[chosen])


def headings() -> None:
    """Print the scores of `PoseKriging` where the recording to fill is turned."""
    names = [f"{row.replace('_', '-')} three-walkers" for row in SIX]
    for degrees in (0.0, 90.0, 180.0):
        problems = [
            load_problem("missing-frames", name, fold) for name in names for fold in range(12)
        ]
        scores = []
        for problem in problems:
            moved = _rotate_problem(problem, degrees)
            outcome = _outcome(moved, PoseKriging().fit(moved.train))
            scores.append([METRICS.get(name)(outcome).value for name in ("rms_per_frame", "mpjpe")])
        print(f"{degrees:g}°", np.round(np.mean(scores, axis=0), 3), flush=True)


def _rotate_problem(problem: ImputeProblem, degrees: float) -> ImputeProblem:
    (given,), (truth,) = problem.given, problem.truth
    turned = rotate_motion(given.with_values(truth), degrees)
    return replace(problem, given=(turned.hide(~given.visible),), truth=(turned.values,))


def others() -> None:
    """Print scores of `PoseKriging` and of ``makima`` on walks of people whom the task lacks."""
    training = load_problem("missing-frames", "35-03 three-walkers", 0).train
    model, makima = PoseKriging(), MakimaImputer()
    scores: dict[str, list[Array]] = {}
    for person, uri in _walks_of_others():
        problems = list(_posed_anywhere(uri, training))
        ours = _mean_scores(model, problems, "rms_per_frame", "mpjpe", "coverage_95")
        found = np.append(ours, _mean_scores(makima, problems, "rms_per_frame"))
        print(uri, np.round(found, 2), flush=True)
        scores.setdefault(person, []).append(found)
    walks = np.concatenate([*scores.values()])
    print(len(walks), "walks:", np.round(walks.mean(axis=0), 3))
    print("greatest ratio:", np.max(walks[:, 0] / walks[:, -1]).round(3))
    errors, of_makima = np.array([np.mean(of, axis=0)[[0, -1]] for of in scores.values()]).T
    for what, each in {"ours": errors, "makima less ours": of_makima - errors}.items():
        low, high = mean_interval(each)
        print(f"{what}, {len(each)} people: {each.mean():.1f} ± {(high - low) / 2:.1f}")


def _walks() -> Iterator[tuple[str, str]]:
    """Yield the person and the address of all walks of people."""
    people = read_people()
    for uri in people.recordings:
        if "walk" in people.shows(uri):
            yield people.person(subject_of(uri)), uri


def _walks_of_others() -> Iterator[tuple[str, str]]:
    """Yield the person and the address of all walks of people whom `missing-frames` lacks."""
    known = {subject_of(uri) for uri in (*TRAINING, *(f"cmu:{test}" for test in TESTS))}
    yield from ((person, uri) for person, uri in _walks() if person not in known)


def many() -> None:
    """Print scores of `PoseKriging` that learns from all other walks, or from some of others."""
    for hold_out, every in ((eq, 1), (_is_of_one, 1), (_is_of_one, 2), (_is_of_one, 4)):
        rows = [_score_taught(f"cmu:{test}", hold_out, every) for test in SIX]
        print(
            f"{hold_out.__name__}, every {every}:", np.round(np.mean(rows, axis=0), 3), flush=True
        )


def _is_of_one(one: str, other: str) -> bool:
    people = read_people()
    return people.person(subject_of(one)) == people.person(subject_of(other))


def _score_taught(test: str, hold_out: Callable[[str, str], bool], every: int) -> Array:
    """Print and return the scores of a row of the task, of all of its windows."""
    archive = bench.archive_at()
    walks = [uri for _, uri in _walks() if not hold_out(uri, test)][::every]
    training = tuple(gpdm_features(archive.recording(uri)) for uri in walks)
    start = gpdm_features(archive.recording(test)).frames(np.arange(N_TEST_FRAMES))
    body = JointAngles(archive.skeleton(test))
    problems = [hide_window(start, training, fold, body) for fold in range(N_WINDOWS)]
    model = PoseKriging().fit(training)
    outcomes = [_outcome(problem, model) for problem in problems]
    names = ("rms_per_frame", "mpjpe", "coverage_95")
    found = np.array([np.mean([METRICS.get(n)(one).value for one in outcomes]) for n in names])
    print(test, f"{len(walks)} walks", np.round(found, 3), flush=True)
    return found


def _posed_anywhere(uri: str, training: tuple[Recording, ...]) -> Iterator[ImputeProblem]:
    """Yield the task's windows in the fifty frames during which the pelvis goes farthest."""
    archive = bench.archive_at()
    walk = archive.recording(uri)
    ground = walk.values[::4, [walk.channels.index(f"root.t{axis}") for axis in "xz"]]
    apart = np.linalg.norm(ground[N_TEST_FRAMES - 1 :] - ground[: 1 - N_TEST_FRAMES], axis=1)
    test = gpdm_features(walk).frames(apart.argmax() + np.arange(N_TEST_FRAMES))
    for fold in range(N_WINDOWS):
        yield hide_window(test, training, fold, JointAngles(archive.skeleton(uri)))


def _mean_scores(model: FrameImputer, problems: Sequence[ImputeProblem], *names: str) -> Array:
    outcomes = [_outcome(problem, model.fit(problem.train)) for problem in problems]
    metrics = [METRICS.get(name) for name in names]
    return np.array([np.mean([of(each).value for each in outcomes]) for of in metrics])


COMMANDS: Mapping[str, Callable[[], None]] = {
    "tasks": tasks,
    "frames": frames,
    "headings": headings,
    "others": others,
    "many": many,
}

if __name__ == "__main__":
    COMMANDS[sys.argv[1]]()
