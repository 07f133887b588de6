"""The page of subject 35's missing leg and upper body."""

from __future__ import annotations

from mocapbench.benchmark.figures.filled_channels import FilledChannels
from mocapbench.reports.bundle.task_page import RowNotes, TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Right leg or upper body of subject 35 missing",
    reference="Taylor 2006 and Lawrence 2007",
    description=(
        "Models are trained on 31 recordings of one subject, 2,613 frames at 30 Hz, mostly walks "
        "and runs. In another recording of the same subject, which no model has seen, the seven "
        "joint angles of the right leg or the 30 of the upper body are hidden from frame 63 of "
        "124 on. Values are 50 joint angles and nine values of the root, each divided by its "
        "standard deviation in training. Errors are in degrees: their root mean square over the "
        "hidden angles, and the papers’ cumulative scaled error, in which each error is multiplied "
        "by its angle’s scale and squared, summed over frames and averaged over angles."
    ),
    metrics=("rms_angle", "cumulative_scaled_error", "coverage_95", "msll", "crps"),
    rows={name: RowNotes(published=name) for name in ("right leg", "upper body")},
    published_models={"nn-scaled": "scaled NN", "nn-radians": "NN"},
    published_metrics={
        "rms_angle": "RMS angle (deg)",
        "cumulative_scaled_error": "cumulative scaled error",
    },
    remarks=(
        "Nearest neighbours are those of Lawrence 2007: in nn-scaled the distance is between "
        "values divided by their standard deviation, in nn-radians between joint angles in "
        "radians. In both the nearest training frame donates what is hidden.",
        "Columns of published values without an entrant here: the GP-LVM with q latent dimensions "
        "(Lawrence 2007); the binary latent variable model, and a nearest neighbour over two "
        "frames and the root’s absolute path (Taylor 2006), of which no errors in degrees are "
        "printed.",
        "There is one recording to fill, so there is one fold and no interval: a difference "
        "between two models says little about other recordings. Models that draw their start vary "
        "with the root seed: cyclic-alignment, in full, had cumulative scaled errors of 7 to 12 "
        "for the leg and of 10 to 30 for the upper body from five seeds.",
        "The recordings 35_13, 14, 19 and 23 to 26 are in use as copies that hold every fourth "
        "frame and interpolate the others. This task reads every fourth frame only, so any copy "
        "does, and none has a registered digest.",
        "An angle a stands as arcsin(sin a), which folds it back where a joint bends beyond a "
        "right angle, as elbows and knees do in some recordings. The truth is folded too.",
    ),
    illustrated=("right leg", "synthetic right leg"),
    figures=(FilledChannels(("rfemur.rx", "rtibia.rx")),),
)
