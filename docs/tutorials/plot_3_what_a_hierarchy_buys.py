"""
What a hierarchy buys
=====================

Six people walk. Each walks in a way of their own, and yet all walks
are alike. A *hierarchical* model says just that: there is a trend,
and each recording varies around it. You see the trend, what it does
for a recording with a gap, and when it does not help.
"""

# %%
# Six replicates
# --------------
#
# We cut one cycle out of each walk, from the moment at which the left
# thigh is farthest forward to the next such moment, and stretch all
# cycles to the same forty frames. Time is then the share of the cycle.
# Gaps lie around the swing of the leg, where the knee bends most.

from collections.abc import Sequence
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from scipy.signal import find_peaks

from mocapbench.datasets import GaitLibrary, Recording, resample

CHANNELS = ("lfemur.rx", "ltibia.rx", "lfoot.rx")
N_FRAMES, SWING = 40, 26


def cycle(key: str, name: str, late: float = 0.0) -> Recording:
    """Return a cycle, begun a share of its length late."""
    recording = GaitLibrary().recording(key).select(CHANNELS)
    forward = -recording.values[:, CHANNELS.index("lfemur.rx")]
    first, second = find_peaks(forward, distance=40, prominence=15.0)[
        0
    ][:2]
    delay = round(late * (second - first))
    even = resample(
        recording.frames(range(first + delay, second + delay + 1)),
        N_FRAMES,
    )
    return replace(
        even, name=name, times=np.linspace(0.0, 100.0, N_FRAMES)
    )


def without_swing(recording: Recording, n_hidden: int) -> Recording:
    """Hide so many frames around the swing, in all joints."""
    hidden = np.zeros(recording.values.shape, dtype=bool)
    start = SWING - n_hidden // 2
    hidden[start : start + n_hidden] = True
    return recording.hide(hidden)


walks = [
    cycle(f"{person:02d}_01", f"person {person}")
    for person in range(1, 7)
]

# %%
# Two models of the same recordings
# ---------------------------------
#
# The first walk loses 16 of its 40 frames. Both models get all six
# recordings.
#
# - ``gp-independent`` learns from all of them *how fast* each joint
#   moves. Each recording is then a draw of its own: what the others do
#   in the gap does not matter.
# - ``mohgp``, the multiple-output hierarchical Gaussian process, has a
#   trend :math:`g` and recordings :math:`f_r` that vary around it, and
#   joints that vary together:
#
# .. math::
#
#    g \sim \mathcal{GP}(0, K_g), \quad
#    f_r \sim \mathcal{GP}(g, K_f), \quad
#    y_r = f_r + \varepsilon_r.

from mocapbench.baselines import MOHGP, GPIndependent

incomplete = without_swing(walks[0], n_hidden=16)
given = [incomplete, *walks[1:]]
independent, hierarchical = (
    GPIndependent().fit(given),
    MOHGP().fit(given),
)

# %%
# The trend and its replicates
# ----------------------------
#
# **Look at** how the trend runs through the middle of the thin lines.
# Its interval says where the trend may lie; it promises nothing about
# single recordings.

KNEE = CHANNELS.index("ltibia.rx")
percent = np.linspace(0.0, 100.0, 200)

mean, variance = hierarchical.trend(percent)
trend, doubt = mean[:, KNEE], 1.96 * np.sqrt(variance[:, KNEE])

# sphinx_gallery_start_ignore
plt.style.use(["seaborn-v0_8-whitegrid", "tableau-colorblind10"])
figure, axis = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for walk in given:
    axis.plot(walk.times, walk.values[:, KNEE], color="C3", lw=1)
axis.plot(
    [], [], color="C3", lw=1, label="six recordings, one with a gap"
)
axis.fill_between(
    percent, trend - doubt, trend + doubt, color="C1", alpha=0.3, lw=0
)
axis.plot(
    percent,
    trend,
    color="C1",
    lw=2,
    label="trend, with its 95 % interval",
)
axis.set(
    xlabel="cycle (%)",
    ylabel="left knee (°)",
    title="One trend, six ways to walk",
)
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# What the gap may have held
# --------------------------
#
# A posterior is more than a curve with an interval: it gives whole
# courses. Each thin line below is one that the model holds possible,
# given all that was seen.
#
# **Look at** the thin lines inside the gap. Which of the two models
# knows that the leg stays straight until its swing begins?

draws = {
    name: model.posterior_draws(
        incomplete, 15, random_state=0, times=percent
    )
    for name, model in (
        ("gp-independent: this recording only", independent),
        ("mohgp: with the trend", hierarchical),
    )
}

# sphinx_gallery_start_ignore
gap = incomplete.times[~incomplete.visible[:, KNEE]][[0, -1]]
figure, axes = plt.subplots(
    2,
    1,
    figsize=(6.4, 5.6),
    sharex=True,
    sharey=True,
    layout="constrained",
)
for axis, (title, courses), color in zip(
    axes, draws.items(), ("C0", "C1"), strict=True
):
    axis.axvspan(*gap, color="C3", alpha=0.15, lw=0, label="gap")
    axis.plot(percent, courses[..., KNEE].T, color=color, lw=0.7)
    axis.plot([], [], color=color, lw=0.7, label="15 draws")
    whole = walks[0].values[:, KNEE]
    axis.plot(walks[0].times, whole, "k--", lw=1.5, label="truth")
    axis.set(title=title, ylabel="left knee (°)")
axes[0].legend(frameon=True)
axes[1].set_xlabel("cycle (%)")
plt.show()
# sphinx_gallery_end_ignore

# %%
# How much it buys
# ----------------
#
# That depends on the gap. We hide 2 to 24 frames of three of the
# walkers in turn, fit both models anew, and take the error over all
# three joints.


def filled(
    model: MOHGP | GPIndependent,
    recordings: Sequence[Recording],
    test: Recording,
):
    """Return errors and deviations at the test's hidden entries."""
    (truth,) = (
        recording
        for recording in recordings
        if recording.name == test.name
    )
    others = [
        recording
        for recording in recordings
        if recording.name != test.name
    ]
    (prediction,) = model.fit([test, *others]).impute([test])
    errors = (prediction.mean - truth.values)[~test.visible]
    return errors, np.sqrt(prediction.variance[~test.visible])


def root_mean_square(errors: np.ndarray) -> float:
    """Return the root of the mean squared error."""
    return float(np.sqrt(np.mean(np.square(errors))))


LENGTHS = (2, 4, 8, 12, 16, 24)
curves = {"gp-independent": [], "mohgp": []}
for n_hidden in LENGTHS:
    tests = [
        without_swing(walk, n_hidden)
        for walk in (walks[0], walks[2], walks[4])
    ]
    for name, model in (
        ("gp-independent", GPIndependent()),
        ("mohgp", MOHGP()),
    ):
        errors = np.concatenate(
            [filled(model, walks, test)[0] for test in tests]
        )
        curves[name].append(root_mean_square(errors))

share = 100 * np.array(LENGTHS) / N_FRAMES

# sphinx_gallery_start_ignore
figure, axis = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for (name, values), marker, color in zip(
    curves.items(), "os", ("C0", "C1"), strict=True
):
    axis.plot(share, values, marker=marker, color=color, label=name)
axis.set(
    xlabel="length of the gap (% of a cycle)",
    ylabel="error (°)",
    ylim=(0, None),
)
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# **Look at** where the two curves part. In a short gap, the frames on
# either side say enough. In a long one, only the trend knows what
# comes.

ratios = np.divide(curves["gp-independent"], curves["mohgp"])
for length, ratio in zip(share, ratios, strict=True):
    print(f"gap of {length:2.0f} % of a cycle: error ÷ {ratio:.1f}")

# %%
# When it buys less
# -----------------
#
# A trend is a promise that recordings do the same *at the same time*.
# What if one does not keep it? We try the same walk, cut half a cycle
# late, and a run of the same person. The five other walks stay.
#
# **Look at** the errors of both models in each pair of rows. Then look
# at the last column: far below 95 %, the model is surer than it should
# be.

tests = {
    "walk": walks[0],
    "walk, late": cycle("01_01", "person 1", late=0.5),
    "run": cycle("01_05", "person 1"),
}
print(
    f"{'':12}{'model':16}{'error':>8}{'mean sd':>10}"
    f"{'in 95 % interval':>20}"
)
for what, recording in tests.items():
    for name, model in (
        ("gp-independent", GPIndependent()),
        ("mohgp", MOHGP()),
    ):
        test = without_swing(recording, n_hidden=16)
        errors, sds = filled(model, [recording, *walks[1:]], test)
        error, within = (
            root_mean_square(errors),
            np.mean(np.abs(errors) < 1.96 * sds),
        )
        print(
            f"{what:12}{name:16}{error:6.1f} °{sds.mean():8.1f} °"
            f"{within:20.0%}"
        )

# %%
# So align recordings first: cut them at the same event, as here, or let
# a model do it (:doc:`/mathematics/alignment`).
#
# Where recordings fall into groups, a deeper hierarchy is the better
# model: ``MOHGP(tree={"person 1": ("run",), "person 2": ("walk",),
# ...})`` puts a trend of each group between the common trend and the
# recordings.
#
# Where next
# ----------
#
# - :doc:`/generated/models/mohgp`: the model's parameters, and where it
#   wins and fails.
# - :doc:`/mathematics/inference`: how the posterior is computed without
#   the matrix of all recordings, joints and frames.
# - :doc:`/results/thesis`: the same question on the tables of the
#   thesis that introduced the model.
# - :doc:`plot_4_is_the_difference_real`: three walkers are few; how
#   many would do?
