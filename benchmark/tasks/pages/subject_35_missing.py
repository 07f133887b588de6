"""The page of subject 35's missing leg and upper body."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.filled_channels import draw_filled_channels
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.benchmark.figures.motions.scaled_values import scaled_angles
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["PAGE"]

PAGE = TaskPage(
    title="Right leg or upper body of subject 35 missing",
    short="Subject 35",
    reference="Taylor 2006 and Lawrence 2007",
    description=(
        "Models learn from 31 recordings of one subject, 2,613 frames at 30 Hz, mostly walks and "
        "runs. In another recording, the seven joint angles of the right leg or the 30 of the "
        "upper body are hidden from frame 63 of 124 on. Values are 50 joint angles and nine of the "
        "root, each over its standard deviation in training."
    ),
    question="other-channels",
    metrics=("rms_angle", "cumulative_scaled_error", "coverage_95", "msll", "crps"),
    published_rows={name: name for name in ("right leg", "upper body")},
    published_models={"nn-scaled": "scaled NN", "nn-radians": "NN"},
    published_metrics={
        "rms_angle": "RMS angle (deg)",
        "cumulative_scaled_error": "cumulative scaled error",
    },
    remarks=(
        "Nearest neighbours are those of Lawrence 2007: nn-scaled compares values divided by their "
        "standard deviation, nn-radians joint angles in radians. The nearest training frame "
        "donates what is hidden.",
        "Published models without an entrant here: the GP-LVM with q latent dimensions (Lawrence "
        "2007), the binary latent variable model and a nearest neighbour over two frames and the "
        "root’s path (Taylor 2006, without errors in degrees).",
        "Missing among the published ones is VGPDS (Damianou 2011), which nobody here has read.",
        "One recording is filled, so there is one fold and no interval: a difference between two "
        "models says little about other recordings.",
        "The constants of channel-kriging were chosen where the second half of either part was "
        "left out in each training recording in turn.",
        "From five root seeds, cyclic-alignment, in full, had cumulative scaled errors of 7 to 12 "
        "for the leg and of 10 to 30 for the upper body.",
        "Copies of 35_13, 14, 19 and 23 to 26 in use hold every fourth frame and interpolate the "
        "others. Only every fourth frame is read here, so any copy does, and none has a registered "
        "digest.",
        "An angle a stands as arcsin(sin a), which folds it where a joint bends beyond a right "
        "angle, as elbows and knees do in some recordings. The truth is folded too.",
    ),
    illustrated=("right leg", "synthetic right leg"),
    figures=(
        partial(
            draw_filled_motion,
            find_body=scaled_angles,
            remark=(
                " The values do not say where the walker is and which way it faces, so it walks on "
                "the spot; angles beyond a right angle are folded back, in the truth too."
            ),
        ),
        partial(draw_filled_channels, channels=("rfemur.rx", "rtibia.rx")),
    ),
)
