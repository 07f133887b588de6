"""The pages of motion prediction."""

from __future__ import annotations

from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.metrics.horizons import HORIZONS
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["ALL_WINDOWS", "CORRECTED", "EIGHT_WINDOWS"]

_ACTIONS = (
    *("basketball", "basketball_signal", "directing_traffic", "jumping"),
    *("running", "soccer", "walking", "washwindow"),
)
_TRAININGS = ("40 files", "35 files")


def _describe_page(title: str, windows: str, published: dict[str, str], *remarks: str) -> TaskPage:
    """Return the page of a task.

    Parameters
    ----------
    title, windows : str
        Its heading, and which windows are tested, in words.
    published : dict
        From our metrics to those that papers print.
    *remarks : str
        Beside those that all have.
    """
    rows = {
        f"{action.replace('_', '-')} {training}": action
        for training in _TRAININGS
        for action in _ACTIONS
    }
    return TaskPage(
        title=title,
        reference="Mao 2019, Dang 2021, Ma 2022, Wan 2025",
        description=(
            f"Ten frames of a person are seen and the next 25 asked, {windows} of one recording of "
            "each of eight actions. Models learn from five others of each. Values are coordinates "
            "of 25 joints; the root’s path and rotation are left out."
        ),
        question="next-frames",
        metrics=tuple(f"mpjpe_at_{frame}" for frame in HORIZONS),
        published_rows=rows if published else {},
        published_metrics=published,
        published_mean="mean" if published else "",
        illustrated=("walking 40 files", "walking 35 files", "synthetic gait"),
        figures=(draw_filled_motion,),
        remarks=(
            "Frames are 60 a second: “80 ms” is 33, “1000 ms” 417.",
            "Errors are means over 38 joints: six never move, and seven coincide with others.",
            "Rows “35 files” lack the five largest training files, of directing traffic and "
            "washing windows, which papers had.",
            "Each action is tested on one recording: intervals are over these eight, of which two "
            "are of one person. Subjects 14, 16, 35 and 49 are learnt from too.",
            *remarks,
        ),
    )


_PRINTED = {f"mpjpe_at_{frame}": f"MPJPE at {printed} ms" for frame, printed in HORIZONS.items()}
_CONTEST = (
    "Lengths are called millimetres, and are 1.24 of them. The first frame of every recording is "
    "the rest pose."
)

ALL_WINDOWS = _describe_page(
    "Motion prediction",
    "in every window",
    _PRINTED,
    _CONTEST,
    "Published values of one model differ between papers, since others trained it anew; each "
    "stands under the paper that prints it.",
    "Papers that print “mean” choose the epoch of their networks by the test error.",
)
EIGHT_WINDOWS = _describe_page(
    "Motion prediction, eight windows",
    "in eight windows",
    {metric: name for metric, name in _PRINTED.items() if metric != "mpjpe_at_14"},
    _CONTEST,
    "The eight windows of running begin within six frames.",
)
CORRECTED = _describe_page(
    "Motion prediction, corrected",
    "in every window",
    {},
    "Lengths are true, and no window or training recording has the rest pose.",
)
