"""Synthesis of walking, of walking with long strides and of soccer kicks (thesis §5.2.2)."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.baselines import Synthesiser
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Case, Entrant, Selection, Task, without_stand_ins
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.benchmark.tasks.thesis_recordings import (
    EVALUATION,
    JOINT_GROUPS,
    TRAINING,
    Window,
    read_excerpt,
)
from mocapbench.datasets import Archive

__all__ = [
    "KICKS",
    "WALKS",
    "ExaggeratedSynthesis",
    "MocapSynthesis",
    "SoccerSynthesis",
    "WalkingSynthesis",
    "exaggerated_synthesis",
    "soccer_synthesis",
    "walking_synthesis",
]

N_SAMPLES = 25

# The thesis's references in its own notation, subject(motion).
WALKS = {
    "12(1)": "cmu:12_01",
    "16(15)": "cmu:16_15",
    "38(2)": "cmu:38_02",
    "35(1)": "cmu:35_01",
    "39(4)": "cmu:39_04",
}
KICKS = {
    "10(5)": "cmu:10_05",
    "10(3)": "cmu:10_03",
    "10(2)": "cmu:10_02",
    "10(6)": "cmu:10_06",
    "11(1)": "cmu:11_01",
}
_ABSENT = "38(2)"
"""The one reference of which few collections of the database have a copy."""

_MATERN = {"kernel": "matern32"}
_THREE = {"n_components": 3, **_MATERN}
_MOHGP_3 = Entrant("mohgp-3", "mohgp", _THREE)
_RBF = {"n_components": 3, "kernel": "rbf"}
_WITH_RBF = (Entrant("mohgp-3-rbf", "mohgp", _RBF), Entrant("moa-3-rbf", "moa", _RBF))
_OTHERS = (
    Entrant("moa-3", "moa", _THREE),
    Entrant("lmc-independent-3", "lmc-independent", _THREE),
    *_WITH_RBF,
)
_SECOND_KERNEL = tuple(entrant.label for entrant in _WITH_RBF)


def _rows(
    question: str,
    trained_on: Mapping[str, str],
    references: Mapping[str, str],
    suffix: str = "",
    not_comparable: Mapping[str, str] | None = None,
) -> tuple[Case, ...]:
    """Return a case per reference, as the thesis has it, and over several at once."""
    groups = {name: (name,) for name in references} | {"all five": tuple(references)}
    if _ABSENT in references:
        groups[f"without {_ABSENT}"] = tuple(name for name in references if name != _ABSENT)
    unseen = tuple(name for name, uri in references.items() if uri not in trained_on.values())
    if len(unseen) < len(references):
        groups["unseen only"] = unseen
    return tuple(
        Case(
            f"{name}{suffix}",
            {"trained on": ", ".join(trained_on), "reference": name},
            tuple(trained_on.values()),
            references=tuple(references[each] for each in group),
            question=question,
            published=name if name in references else None,
            not_comparable=not_comparable or {},
        )
        for name, group in groups.items()
    )


def _synthetic(trained_on: tuple[str, ...], references: tuple[str, ...]) -> Case:
    return Case(
        "synthetic",
        {"trained on": "generated gait", "reference": f"{len(references)} generated"},
        tuple(f"gait:{key}" for key in trained_on),
        references=tuple(f"gait:{key}" for key in references),
        synthetic=True,
        remark="Generated gait, not recordings of people.",
    )


def _profiles(cases: tuple[Case, ...], *quick: str) -> dict[str, Selection]:
    return {
        "smoke": Selection(
            ("synthetic",),
            folds=1,
            budget={"max_iter": 5, "n_restarts": 1},
            without=_SECOND_KERNEL,
        ),
        "quick": Selection(
            (*quick, "synthetic"),
            folds=1,
            budget={"max_iter": 30},
            without=("gpdm", *_SECOND_KERNEL),
        ),
        "paper": Selection(without_stand_ins(cases), folds=5, budget={"max_iter": 200}),
    }


class MocapSynthesis(Task):
    """Train on a few recordings, draw 25 new ones, and compare them with people never seen."""

    kind = "synthesise"
    version = 1
    requires = (Synthesiser,)
    entrants: tuple[Entrant, ...] = (_MOHGP_3, *_OTHERS)
    metrics = ("mcc", "mlc")
    published_models = {
        **dict.fromkeys(("mohgp-3", "mohgp-3-rbf"), "MOHGP"),
        **dict.fromkeys(("moa-3", "moa-3-rbf"), "MOA"),
    }
    published_metrics = {"mcc": "MCC", "mlc": "MLC"}
    windows: Mapping[str, Mapping[str, Window]] = {}
    """Frames of the training recordings by question, where they are not those of `TRAINING`."""
    remarks: tuple[str, ...] = (
        "The thesis does not disclose its 39 channels or its exact resampling. MCC and MLC scale "
        "each recording's channels to [0, 1]; models see angles as recorded.",
        "The thesis does not name the kernel here. Matérn-3/2 is that of its interpolation of "
        "walks. The RBF was added after seeing the published values, to which its MLC is closer "
        "from two walks and from short kicks, and not from a walk and a stride.",
        "Real motions differ: judge a model by the reference that its samples match best "
        "(thesis §A.4.2), which the table of best matches shows beside the mean.",
        "Folds vary the start of the search and the samples, not the recordings.",
        "Spread divides how samples vary by how the references differ among themselves, which no "
        "model is told: it says here neither that one is too sure nor that it is too cautious.",
    )

    def problem(self, case: Case, seeds: Seeds, archive: Archive) -> SynthesiseProblem:
        """Train on the case's recordings; draw at the first one's times."""
        del seeds  # the recordings are all there is
        windows = self.windows.get(case.asked, TRAINING)
        train = tuple(read_excerpt(archive, uri, windows) for uri in case.sources)
        references = (read_excerpt(archive, uri, EVALUATION) for uri in case.references)
        return SynthesiseProblem(
            train=train,
            process=None,
            times=train[0].times,
            n_samples=N_SAMPLES,
            references=tuple(reference.values for reference in references),
        )


_TRAINED_ON_TWO = "the paper trained this model on two walks"
_TRAINED_ON_THREE = "the paper trained this model on three walks"
_TWO = {"2(1)": "cmu:02_01", "2(2)": "cmu:02_02"}


class WalkingSynthesis(MocapSynthesis):
    """Tables 14–15: one component a layer on three walks, and three components on two."""

    name = "walking-synthesis"
    title = "Walking synthesis"
    reference = "thesis §5.2.2, Tables 14–15, Figures 8 and 22"
    description = (
        "Models learn from two walks of one person, or from three of two persons; 25 samples of "
        "each are compared with walks of other people, in 39 joint angles and 90 frames. Table 14 "
        "is of one component a layer and three walks, and of three components and two walks."
    )
    cases = (
        *_rows("two walks", _TWO, WALKS, not_comparable={"mohgp-1": _TRAINED_ON_THREE}),
        *_rows(
            "three walks",
            {**_TWO, "7(2)": "cmu:07_02"},
            WALKS,
            suffix=" from three walks",
            not_comparable=dict.fromkeys(("mohgp-3", "moa-3", *_SECOND_KERNEL), _TRAINED_ON_TWO),
        ),
        _synthetic(("01_01", "01_02"), ("02_01", "03_01", "04_01")),
    )
    entrants = (Entrant("mohgp-1", "mohgp", {"n_components": 1, **_MATERN}), _MOHGP_3, *_OTHERS)
    profiles = _profiles(cases, "35(1)", f"without {_ABSENT}")
    published_models = {"mohgp-1": "MOHGP-ICM", **MocapSynthesis.published_models}
    illustrated = ("35(1)", "12(1)", "synthetic")
    coregionalisation_of = ("mohgp-3",)
    joint_groups = JOINT_GROUPS


class ExaggeratedSynthesis(MocapSynthesis):
    """Table 16: a walk and a walk with an exaggerated stride."""

    name = "exaggerated-synthesis"
    title = "Exaggerated walking synthesis"
    reference = "thesis §5.2.2, Table 16, Figures 9 and 23"
    description = (
        "Models learn from a walk of one person and a walk with an exaggerated stride of another; "
        "25 samples of each are compared with walks of other people."
    )
    cases = (
        *_rows("walk and stride", {"2(1)": "cmu:02_01", "8(7)": "cmu:08_07"}, WALKS),
        _synthetic(("01_01", "02_04"), ("03_01", "04_01", "05_01")),
    )
    profiles = _profiles(cases, f"without {_ABSENT}")


class SoccerSynthesis(MocapSynthesis):
    """Table 17: two soccer kicks of one person."""

    name = "soccer-synthesis"
    title = "Soccer synthesis"
    reference = "thesis §5.2.2, Table 17, Figures 10 and 24"
    description = (
        "Models learn from two soccer kicks of one person; 25 samples of each are compared with "
        "kicks of this and of another person. Two of the five references are excerpts of the kicks "
        "that models learn from, and the very recordings where those are short kicks: like the "
        "thesis, judge best matches by the three unseen. The generated stand-in runs rather than "
        "kicks."
    )
    cases = (
        *_rows("two kicks", {"10(5)": "cmu:10_05", "10(6)": "cmu:10_06"}, KICKS),
        *_rows(
            "two short kicks",
            {"10(5) short": "cmu:10_05", "10(6) short": "cmu:10_06"},
            KICKS,
            suffix=" from short kicks",
        ),
        _synthetic(("01_05", "02_05"), ("03_05", "04_05", "05_05")),
    )
    profiles = _profiles(cases, "all five")
    windows = {"two short kicks": EVALUATION}
    remarks = (
        *MocapSynthesis.remarks,
        "The thesis's footnotes cut the kicks to 436 frames for training and to 232 frames for the "
        "comparison, so that frame by frame a sample is compared with another part of the kick. "
        "Its MLC suggests that it trained on what it compared with; the rows of short kicks, "
        "where recordings are cut for training as for the comparison, are that reading.",
    )


walking_synthesis = WalkingSynthesis()
exaggerated_synthesis = ExaggeratedSynthesis()
soccer_synthesis = SoccerSynthesis()
