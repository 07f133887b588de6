"""The page of missing frames."""

from __future__ import annotations

from functools import partial

from mocapbench.benchmark.figures.filled_channels import draw_filled_channels
from mocapbench.benchmark.figures.latent_space import draw_latent_spaces
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.benchmark.tasks.gpdm_entrants import WITH_BEST_START
from mocapbench.reports.bundle.task_page import TaskPage

__all__ = ["NOTHING_OVER_TIME", "PAGE"]

NOTHING_OVER_TIME = (
    "pca-regression and low-rank learn nothing over time: on whole hidden frames they give each "
    "channel’s mean in the recording, to which channel-kriging tends too."
)
"""A remark of every task that hides whole frames; the page shows it once."""

_TESTS = ("35-03", "12-02", "16-21", "12-03", "07-01", "07-02", "08-01", "08-02")
_GROUPS = ("four-walkers", "three-walkers")

PAGE = TaskPage(
    title="Missing frames",
    reference="GPDM §5.4, Table 2",
    description=(
        "Fifty frames at 30 Hz of a walker that models have not seen, of which 31 whole frames in "
        "a row are hidden. A fold is one of twelve overlapping windows, from frames 5–35 to 16–46. "
        "Values are 44 joint angles, three root rotations and three root translation differences."
    ),
    question="hidden-frames",
    metrics=(
        *("rms_per_frame", "mpjpe", "angle_error_per_frame", "root_error_per_frame"),
        *("coverage_95", "msll", "crps"),
    ),
    published_rows={f"{test} {group}": test for group in _GROUPS for test in _TESTS},
    published_models={
        "cubic-spline": "cubic-spline",
        "knn": "KNN-15",
        "gpdm-map-linear": "GPDM-MAP",
        "gpdm-balanced-mean": "B-GPDM",
        "gpdm-fixed-alpha-window": "GPDM-fixed-alpha",
        "gpdm-two-stage-window": "GPDM-two-stage-MAP",
    },
    published_metrics={"rms_per_frame": "RMS per frame"},
    not_comparable={
        ("knn", "*"): "the paper does not print its KNN objective, and no reading of it so far "
        "gives its column"
    },
    remarks=(
        "Rows “three-walkers” lack the training walker 10_04, which the paper had.",
        "The paper’s “RMS error per frame” is the mean Euclidean norm of the 50-channel error.",
        "The paper does not say where the latent path of a gap starts, which matters more than how "
        "a model learns. The last word of a GPDM label is its start.",
        "Published GPDM columns stand beside the start whose mean came nearest to them, chosen by "
        "looking at them. Every way of learning enters with its best start too.",
        "GPDM Table 1, four walkers (MAP, balanced, fixed α, two-stage): SNR(α) 6.47, 940, 100, "
        "18.0; CLS(α) 0.32, 1.44, 2.24, 0.75; SNR(β) 34.0, 5.23, 9.32, 45.0; CLS(β) 0.54, 0.77, "
        "1.43, 1.34. Ours stand with the latent spaces.",
        "Learning of the GPDM family stops after a stated number of iterations, while its "
        "parameters still drift.",
        "In cyclic-alignment-centred a cycle’s deviation from its parent is smooth, not the cycle: "
        "chosen on the training walkers, each left out in turn.",
        "Two-stage learning draws 25 samples a round here and 50 in the paper; the windows of a "
        "recording share one fit.",
        "The constants of pose-kriging have about the least error when each training walker is "
        "left out in turn. It alone uses that left and right take turns: it also learns from "
        "mirror images of walkers, by the names of channels.",
        "Sharper and flatter weights of matched walkers, other priors of their blend, its "
        "posterior as doubt, and rough paths alone did not err less for pose-kriging on recordings "
        "that it learns from.",
        NOTHING_OVER_TIME,
        "The GPDM family knows no difference between persons, so its variances are too small "
        "for a new one. They, and those of lds, fam, low-rank and cyclic-alignment, are calibrated "
        "by held-out gaps in visible frames.",
        "Held-out gaps are shorter than the gap: gaps of half their length tell how errors grow.",
        "Four of the fifty channels are constant in training. The GPDM family leaves them out, "
        "which hardly changes errors and lowers SNR(β).",
    ),
    illustrated=("07-01 three-walkers", "synthetic 1"),
    figures=(
        draw_filled_motion,
        partial(draw_filled_channels, channels=("lfemur.rx", "rhumerus.rx")),
        partial(draw_latent_spaces, labels=tuple(entrant.label for entrant in WITH_BEST_START)),
    ),
)
