"""The pages of the gaps of many people."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = [
    "IN_BETWEENING",
    "IN_BETWEENING_ANGLES",
    "LOST_LIMB",
    "LOST_LIMB_ANGLES",
    "LOST_MARKERS",
    "LOST_MARKERS_ANGLES",
]

_HIDDEN: Mapping[str, tuple[str, str, str]] = {
    "a limb": ("Lost limb", "an arm or a leg", "other-channels"),
    "five joints": ("Lost markers", "five joints at once", "other-channels"),
    "whole frames": ("In-betweening", "the whole body", "hidden-frames"),
}
"""By what is hidden: a title, what it is in a sentence, and the question."""
_VALUES: Mapping[str, tuple[str, str, tuple[str, ...]]] = {
    "positions": (
        "",
        "positions of 31 joints in cm, without the path on the floor",
        ("mpjpe", "bone_length_error", "jerk_ratio", "coverage_95", "msll", "crps"),
    ),
    "angles": (
        ", joint angles",
        "44 joint angles, three root rotations and differences of three translations",
        ("angle_error_per_frame", "mpjpe", "coverage_95", "msll", "crps"),
    ),
}
"""By what recordings hold: the end of the title, what it is in a sentence, the metrics."""

_LEARNT: Mapping[str, str] = {
    "alone": "the recording alone",
    "own": "three others of the person",
    "10 strangers": "10 of strangers",
}
"""What models learn from in what the first screen asks."""


def _ask(values: str, hidden: str) -> Mapping[str, str]:
    """Return what cases of a second ask, recordings of people or generated walkers."""
    what, measured = hidden.capitalize(), " (angles)" if values == "angles" else ""
    return {
        f"{made}1 s {regime}": f"{what} lost for 1 s{measured}, learnt from {learnt}"
        for made in ("", "synthetic ")
        for regime, learnt in _LEARNT.items()
    }


_LONG = (
    "Intervals hold .89 to .91 of gaps of two seconds. Variances that grow with the length of the "
    "gap would hold .92 to .93, at a CRPS 1 to 3 % larger."
)
_STEPS = (
    "The frame before a gap is neither shown nor asked: translations are steps, of which its own "
    "would tell where the root is in the gap."
)


def _describe_page(values: str, hidden: str) -> TaskPage:
    """Return the page of a task, by the keys of `_VALUES` and `_HIDDEN`."""
    title, what, question = _HIDDEN[hidden]
    end, held, metrics = _VALUES[values]
    return TaskPage(
        title=f"{title}{end}",
        reference="this project’s own protocol",
        description=(
            f"Of each person, {what} is hidden for .25 to 2 s, up to three times. A fold is a "
            "recording of another person. Models learn from its visible part, from three others of "
            f"the person, or from 3 to 100 of strangers. Values are {held}."
        ),
        question=question,
        metrics=metrics,
        asks=_ask(values, hidden),
        along=("recordings", "seconds"),
        figures=(draw_filled_motion,),
        remarks=(
            "People are split into three groups; strangers are of the two in which a person is "
            "not. Fewer recordings of strangers are the first of more.",
            "What is hidden, and where, depends on the recording and not on the length of gaps or "
            "on training, so that curves compare like with like. Five frames or more stay visible "
            "at the ends and between gaps.",
            *([_LONG] if (values, hidden) == ("positions", "whole frames") else []),
            *([_STEPS] if (values, hidden) == ("angles", "whole frames") else []),
            "Subjects 60 and 61 dance with each other. Statistics count them as one person.",
        ),
    )


LOST_LIMB, LOST_MARKERS, IN_BETWEENING = (_describe_page("positions", what) for what in _HIDDEN)
LOST_LIMB_ANGLES, LOST_MARKERS_ANGLES, IN_BETWEENING_ANGLES = (
    _describe_page("angles", what) for what in _HIDDEN
)
