"""How good the model is that `mocapbench fill --model best` chooses.

Gaps are cut into recordings of the CMU database, of different people and motions, and filled by
every able model. Errors are root mean squared errors over the hidden angles, in degrees. The choice
is compared with the model that hindsight would have chosen, and with linear interpolation. Takes
a quarter of an hour on two cores:

    MOCAPBENCH_DATA=FOLDER python docs/evidence/fill.py
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mocapbench.benchmark.filling.able import able_models
from mocapbench.benchmark.filling.question import Question
from mocapbench.benchmark.filling.trials.choice import Choice, choose
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.datasets import AcclaimFormat, Mask, Recording, unwrapped

RECORDINGS = {
    "02_01": "walk",
    "02_03": "run",
    "02_04": "jump",
    "02_06": "bend over, scoop up",
    "02_09": "swordplay",
    "02_10": "wash oneself",
    "07_01": "walk",
    "09_01": "run",
    "10_02": "kick a ball",
    "11_01": "kick a ball",
    "16_03": "high jump",
    "16_22": "walk, veer",
    "35_01": "walk",
    "39_01": "climb",
    "64_01": "golf swing",
    "64_20": "golf, place a ball",
}
LONGEST = 1500
"""Frames."""
BUDGET = 15.0
"""Seconds."""
LIMBS = (("lfemur", "ltibia", "lfoot", "ltoes"), ("rhumerus", "rradius", "rwrist", "rhand"))


class Cut(NamedTuple):
    """How gaps are cut: in which channels, how many, and from how many to how many frames."""

    groups: tuple[tuple[str, ...], ...]
    count: int
    shortest: int
    longest: int


class Result(NamedTuple):
    """Errors in degrees of each model in the file itself, and how they did in trials."""

    errors: dict[str, float]
    choice: Choice


def cuts(recording: Recording) -> dict[str, Cut]:
    """Return three ways to lose entries: whole frames, a limb, single segments."""
    segments = tuple({name.split(".")[0]: () for name in recording.channels})
    return {
        "frames": Cut((segments,), 4, 8, 30),
        "limbs": Cut(LIMBS, 8, 12, 60),
        "segments": Cut(tuple((segment,) for segment in segments), 16, 8, 80),
    }


def mask_of(recording: Recording, cut: Cut, rng: np.random.Generator) -> Mask:
    """Return a mask with gaps at random places, none of which touch."""
    owners = np.array([name.split(".")[0] for name in recording.channels])
    hidden, n_frames = np.zeros(recording.values.shape, dtype=bool), len(recording.times)
    for _ in range(cut.count):
        length = int(rng.integers(cut.shortest, min(cut.longest, n_frames // 8) + 1))
        channels = np.isin(owners, cut.groups[rng.integers(len(cut.groups))])
        for start in rng.integers(3, n_frames - length - 3, size=50):
            beside = hidden[start - 3 : start + length + 3]
            if not beside[:, channels].any():
                hidden[start : start + length, channels] = True
                break
    return hidden


def problems(folder: Path) -> Iterator[tuple[str, str, Recording, Mask]]:
    """Yield each recording with each kind of gaps."""
    for name in RECORDINGS:
        whole = AcclaimFormat().read(folder / "subjects" / name[:2] / f"{name}.amc")
        recording = whole.frames(np.arange(min(len(whole.times), LONGEST)))
        for kind, cut in cuts(recording).items():
            rng = np.random.default_rng([int(name[:2]), int(name[3:]), len(kind)])
            yield name, kind, recording, mask_of(recording, cut, rng)


def evaluate(recording: Recording, hidden: Mask, workers: Workers, budget: float) -> Result:
    """Return how the choice and every other able model fill the gaps."""
    question = Question(unwrapped(recording.hide(hidden)), hidden)
    choice = choose(question, workers, budget, lambda *_: None)
    kept = workers.keep(question)
    able = [model for model in able_models(question) if model in choice.ranking.order]
    futures = {model: workers.submit(model, kept, 600.0) for model in able}
    errors = {}
    for model, future in futures.items():
        answer = workers.result(future).answer
        if answer is not None:
            errors[model] = error_in_degrees(recording, hidden, answer.mean)
    return Result(errors, choice)


def error_in_degrees(recording: Recording, hidden: Mask, mean: np.ndarray) -> float:
    """Return the root mean squared error over hidden angles, whole turns aside."""
    angles = np.array(recording.units)[np.nonzero(hidden)[1]] == "deg"
    off = (mean - recording.values[hidden])[angles]
    return float(np.sqrt(np.mean((off - 360.0 * np.round(off / 360.0)) ** 2)))


def main() -> None:
    """Print a row per recording and kind of gaps, and how often the bars are missed."""
    rows = []
    folder = Path(os.environ["MOCAPBENCH_DATA"])
    print("| recording | gaps | n | best | error, ° | hindsight | error, ° | linear, ° |")
    print("|---|---|---|---|---|---|---|---|")
    with Workers(os.cpu_count() or 1) as workers:
        for name, kind, recording, hidden in problems(folder):
            errors, choice = evaluate(recording, hidden, workers, BUDGET)
            best, hindsight = choice.ranking.order[0], min(errors, key=errors.__getitem__)
            rows.append((errors[best] / errors[hindsight], errors[best] / errors["linear"]))
            print(
                f"| {name} {RECORDINGS[name]} | {kind} | {choice.ranking.n} | {best} | "
                f"{errors[best]:.2f} | {hindsight} | {errors[hindsight]:.2f} | "
                f"{errors['linear']:.2f} |",
                flush=True,
            )
    to_hindsight, to_linear = np.array(rows).T
    for what, ratio, bar in (("hindsight", to_hindsight, 1.10), ("linear", to_linear, 1.05)):
        print(
            f"\nRelative to {what}: mean {ratio.mean():.3f}, median {np.median(ratio):.3f}, "
            f"largest {ratio.max():.2f}; above {bar} in {(ratio > bar).sum()} of {len(ratio)}."
        )


if __name__ == "__main__":
    main()
