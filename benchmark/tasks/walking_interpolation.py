"""Interpolation of walking from other walkers (thesis §5.1.2, Tables 10–11)."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.masks import hide_all_but
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.walking_interpolation import PAGE
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import THESIS_CHANNELS, Archive, Recording, resample, zero_based_frames

__all__ = ["walking_interpolation", "walking_problem"]

N_FRAMES = 90
WINDOW = (0, 298)
WALKERS = ("cmu:02_01", "cmu:02_02", "cmu:07_02")
SYNTHETIC_WALKERS = ("gait:01_01", "gait:01_02", "gait:02_01")

_MATERN = {"kernel": "matern32"}
_ONE_SEARCH = {"n_restarts": 1, **_MATERN}
_ONE_AND_FIVE = {"n_components": {"parent": 1, "child": 5}, **_ONE_SEARCH}


def walking_problem(
    walkers: tuple[str, ...], n_visible: int, seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide all but ``n_visible`` frames of each channel of the first walk."""
    first, *others = (_walk(archive, uri) for uri in walkers)
    given = first.hide(hide_all_but(seeds.generator("mask"), n_visible, *first.values.shape))
    return ImputeProblem(
        train=(given, *others),
        given=(given,),
        truth=(first.values,),
        unit=Unit.range_of(first.values),
        body=JointAngles(archive.skeleton(walkers[0])),
    )


def _walk(archive: Archive, uri: str) -> Recording:
    return resample(zero_based_frames(archive.recording(uri), *WINDOW), N_FRAMES).select(
        THESIS_CHANNELS
    )


def _case(
    name: str, n_visible: int, walkers: tuple[str, ...] = WALKERS, *, synthetic: bool = False
) -> Case:
    problem = partial(walking_problem, walkers, n_visible)
    return Case(name, problem, {"visible frames": n_visible}, walkers, synthetic=synthetic)


_CASES = (
    *(_case(f"observed {n}", n) for n in (40, 30, 20, 10)),
    _case("synthetic observed 40", 40, SYNTHETIC_WALKERS, synthetic=True),
)

walking_interpolation: Task = Task(
    name="walking-interpolation",
    version=1,
    page=PAGE,
    requires={"fills entries"},
    cases=_CASES,
    entrants=(
        Entrant("mohgp-1", "mohgp", {"n_components": 1, **_ONE_SEARCH}),
        Entrant("mohgp-3", "mohgp", {"n_components": 3, **_ONE_SEARCH}),
        Entrant("mohgp-1+5", "mohgp", _ONE_AND_FIVE),
        Entrant("mohgp-1+5-registered", "mohgp", {"registration": "affine", **_ONE_AND_FIVE}),
        Entrant("moa-1", "moa", {"n_components": 1, **_MATERN}),
        Entrant("moa-3", "moa", {"n_components": 3, **_MATERN}),
        Entrant("lmc-independent-1", "lmc-independent", {"n_components": 1, **_MATERN}),
        Entrant("gp-independent", "gp-independent", _MATERN),
    ),
    profiles={
        "smoke": Profile(
            ("synthetic observed 40",),
            folds=1,
            budget={"max_iter": 2, "n_restarts": 1},
            opt_in=(
                *("mohgp-1+5", "mohgp-1+5-registered", "mohgp-1", "hgp", "best-of"),
                *("cyclic-alignment", "channel-kriging", "gp-independent"),
            ),
        ),
        "quick": Profile(
            ("observed 40", "synthetic observed 40"),
            folds=1,
            budget={"max_iter": 150},
            # Longer than all others together.
            opt_in=(
                *("mohgp-1+5", "mohgp-1+5-registered", "mohgp-1"),
                *("cyclic-alignment", "best-of"),
            ),
        ),
        "paper": Profile(on_recordings(_CASES), folds=5, budget={"max_iter": 500}),
    },
)
"""The first walker has some of 90 frames visible, the others are complete."""
