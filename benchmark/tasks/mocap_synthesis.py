"""Synthesis of walking, of walking with long strides and of soccer kicks (thesis §5.2.2)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task, on_recordings
from mocapbench.benchmark.tasks.pages.mocap_synthesis import (
    EXAGGERATED_PAGE,
    SOCCER_PAGE,
    WALKING_PAGE,
)
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.thesis_recordings import (
    EVALUATION,
    KICKS,
    TRAINING,
    WALKS,
    Window,
    read_excerpt,
)
from mocapbench.datasets import Archive, subject_of

__all__ = ["exaggerated_synthesis", "motion_problem", "soccer_synthesis", "walking_synthesis"]

N_SAMPLES = 25

_ABSENT = "38(2)"
"""The one reference of which few collections of the database have a copy."""

_MATERN = {"kernel": "matern32"}
_THREE = {"n_components": 3, **_MATERN}
_ONE_SEARCH = {"n_restarts": 1}
_MOHGP_3 = Entrant("mohgp-3", "mohgp", _THREE | _ONE_SEARCH)
_RBF = {"n_components": 3, "kernel": "rbf"}
_WITH_RBF = (Entrant("mohgp-3-rbf", "mohgp", _RBF | _ONE_SEARCH), Entrant("moa-3-rbf", "moa", _RBF))
_OTHERS = (
    Entrant("moa-3", "moa", _THREE),
    Entrant("lmc-independent-3", "lmc-independent", _THREE),
    *_WITH_RBF,
)
_SECOND_KERNEL = tuple(entrant.label for entrant in _WITH_RBF)
_NOT_SMOKE = (
    *("gpdm", "hgp", "gp-independent", "cyclic-alignment"),
    *("moa-3", "lmc-independent-3"),
)
"""The smoke profile tries these in one of the tasks of synthesis."""


def motion_problem(
    given: tuple[str, ...],
    windows: Mapping[str, Window],
    seeds: Seeds,
    archive: Archive,
    *,
    references: tuple[str, ...],
) -> SynthesiseProblem:
    """Train on excerpts of ``given`` within ``windows``; draw at the first one's times."""
    del seeds  # the recordings are all there is
    train = tuple(read_excerpt(archive, uri, windows) for uri in given)
    return SynthesiseProblem(
        train=train,
        times=train[0].times,
        n_samples=N_SAMPLES,
        references=tuple(read_excerpt(archive, uri, EVALUATION).values for uri in references),
        body=JointAngles(archive.skeleton(given[0])),
    )


def _rows(
    problem_name: str,
    trained_on: Mapping[str, str],
    references: Mapping[str, str],
    suffix: str = "",
    windows: Mapping[str, Window] = TRAINING,
) -> tuple[Case, ...]:
    """Return a case per reference, as the thesis has it, and over several at once."""
    groups = {name: (name,) for name in references} | {"all five": tuple(references)}
    if _ABSENT in references:
        groups[f"without {_ABSENT}"] = tuple(name for name in references if name != _ABSENT)
    unseen = tuple(name for name, uri in references.items() if uri not in trained_on.values())
    if len(unseen) < len(references):
        groups["unseen only"] = unseen
    given = tuple(trained_on.values())
    return tuple(
        Case(
            f"{name}{suffix}",
            partial(motion_problem, given, windows, references=uris),
            {"trained on": ", ".join(trained_on), "reference": name},
            given,
            uris,
            problem_name=problem_name,
            subjects=(subject_of(uris[0]),) if len(uris) == 1 else (),
        )
        for name, group in groups.items()
        for uris in [tuple(references[member] for member in group)]
    )


def _synthetic(trained_on: tuple[str, ...], compared_with: tuple[str, ...]) -> Case:
    given = tuple(f"gait:{key}" for key in trained_on)
    references = tuple(f"gait:{key}" for key in compared_with)
    return Case(
        "synthetic",
        partial(motion_problem, given, TRAINING, references=references),
        {"trained on": "generated gait", "reference": f"{len(references)} generated"},
        given,
        references,
        synthetic=True,
    )


def _profiles(
    cases: tuple[Case, ...], *quick: str, slow_in_smoke: tuple[str, ...] = _NOT_SMOKE
) -> dict[str, Profile]:
    return {
        "smoke": Profile(
            ("synthetic",),
            folds=1,
            budget={"max_iter": 2, "n_restarts": 1},
            opt_in=(*slow_in_smoke, *_SECOND_KERNEL),
        ),
        "quick": Profile(
            (*quick, "synthetic"),
            folds=1,
            budget={"max_iter": 30},
            opt_in=("gpdm",),
        ),
        "paper": Profile(on_recordings(cases), folds=5, budget={"max_iter": 200}),
    }


_TWO_WALKS = {"2(1)": "cmu:02_01", "2(2)": "cmu:02_02"}
_THREE_WALKS = {**_TWO_WALKS, "7(2)": "cmu:07_02"}
_WALKING = (
    *_rows("two walks", _TWO_WALKS, WALKS),
    *_rows("three walks", _THREE_WALKS, WALKS, suffix=" from three walks"),
    _synthetic(("01_01", "01_02"), ("02_01", "03_01", "04_01")),
)
_EXAGGERATED = (
    *_rows("walk and stride", {"2(1)": "cmu:02_01", "8(7)": "cmu:08_07"}, WALKS),
    _synthetic(("01_01", "02_04"), ("03_01", "04_01", "05_01")),
)
_SOCCER = (
    *_rows("two kicks", {"10(5)": "cmu:10_05", "10(6)": "cmu:10_06"}, KICKS),
    *_rows(
        "two short kicks",
        {"10(5) short": "cmu:10_05", "10(6) short": "cmu:10_06"},
        KICKS,
        suffix=" from short kicks",
        windows=EVALUATION,
    ),
    _synthetic(("01_05", "02_05"), ("03_05", "04_05", "05_05")),
)

walking_synthesis: Task = Task(
    name="walking-synthesis",
    version=1,
    page=WALKING_PAGE,
    requires={"draws samples"},
    cases=_WALKING,
    entrants=(
        Entrant("mohgp-1", "mohgp", {"n_components": 1, **_MATERN, **_ONE_SEARCH}),
        _MOHGP_3,
        *_OTHERS,
    ),
    profiles=_profiles(_WALKING, "35(1)", f"without {_ABSENT}", slow_in_smoke=()),
)
"""Tables 14–15: one component a layer on three walks, and three components on two."""

exaggerated_synthesis: Task = Task(
    name="exaggerated-synthesis",
    version=1,
    page=EXAGGERATED_PAGE,
    requires={"draws samples"},
    cases=_EXAGGERATED,
    entrants=(_MOHGP_3, *_OTHERS),
    profiles=_profiles(_EXAGGERATED, f"without {_ABSENT}"),
)
"""Table 16: a walk, and a walk with an exaggerated stride."""

soccer_synthesis: Task = Task(
    name="soccer-synthesis",
    version=1,
    page=SOCCER_PAGE,
    requires={"draws samples"},
    cases=_SOCCER,
    entrants=(_MOHGP_3, *_OTHERS),
    profiles=_profiles(_SOCCER, "all five"),
)
"""Table 17: two soccer kicks of one person."""
