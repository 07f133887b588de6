"""The pages of the gaps of many people."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["describe_page"]

_HIDDEN: Mapping[str, tuple[str, str, str]] = {
    "a limb": ("Lost limb", "an arm or a leg", "other-channels"),
    "five joints": ("Lost markers", "five joints at once", "other-channels"),
    "whole frames": ("In-betweening", "the whole body", "hidden-frames"),
}
"""By what is hidden: a title, what it is in a sentence, and the question."""
_ILLUSTRATED = ("1 s 10 strangers", "synthetic 1 s 10 strangers")
_VALUES: Mapping[str, tuple[str, str, tuple[str, ...]]] = {
    "positions": (
        "",
        "positions of 31 joints in cm, without the root’s path on the floor",
        ("mpjpe", "bone_length_error", "jerk_ratio", "coverage_95", "msll", "crps"),
    ),
    "angles": (
        ", joint angles",
        "44 joint angles, three root rotations and three root translation differences",
        ("angle_error_per_frame", "mpjpe", "coverage_95", "msll", "crps"),
    ),
}
"""By what recordings hold: the end of the title, what it is in a sentence, the metrics."""


def describe_page(values: str, hidden: str, cases: Collection[str]) -> TaskPage:
    """Return the page of a task.

    Parameters
    ----------
    values : str
        ``positions`` or ``angles``.
    hidden : str
        ``a limb``, ``five joints`` or ``whole frames``.
    cases : collection of str
        The names of the task's cases.
    """
    title, what, question = _HIDDEN[hidden]
    end, held, metrics = _VALUES[values]
    return TaskPage(
        title=f"{title}{end}",
        reference="this project’s own protocol",
        description=(
            f"Of each person, {what} is hidden for a quarter of a second to two seconds, up to "
            "three times in a recording. A fold is a recording of another person. Models learn "
            "from its visible part alone, from up to three other recordings of the person, or from "
            f"3 to 100 recordings of others. Values are {held}, at 30 Hz."
        ),
        question=question,
        metrics=metrics,
        along=("recordings", "seconds"),
        illustrated=tuple(case for case in _ILLUSTRATED if case in cases),
        figures=(draw_filled_motion,),
        remarks=(
            "People are split into three groups; strangers are of the two in which a person is "
            "not. Fewer recordings of strangers are the first of more.",
            "What is hidden, and where, depends on the fold and not on the length of gaps or on "
            "training, so that curves compare like with like. Five frames or more stay visible at "
            "the ends and between gaps.",
            "Subjects 60 and 61 dance with each other. Statistics count them as one person.",
        ),
    )
