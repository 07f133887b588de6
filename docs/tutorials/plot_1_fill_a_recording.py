"""
Fill a recording and look at its intervals
==========================================

Eight people walk, and each recording has a gap of two thirds of a
second in which nothing was seen. Three models fill the gaps. You
learn to look at three things: the *curve* that is filled in, the
*interval* around it, and the *coverage*, which tells whether the
intervals can be believed.
"""

# %%
# Walks with gaps
# ---------------
#
# The walks are generated. They have the joint angles of the CMU Motion
# Capture Database. We keep 30 of 120 frames a second, and eight joints
# that swing. Four more people have no gap: models may learn from them.

import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import norm

from mocapbench.datasets import GaitLibrary, Recording

JOINTS = (
    "lfemur",
    "ltibia",
    "lfoot",
    "lhumerus",
    "rfemur",
    "rtibia",
    "rfoot",
    "rhumerus",
)
GAP = 20  # frames


def walk(person: int) -> Recording:
    """Return a walk of one person."""
    recording = GaitLibrary().recording(f"{person:02d}_01")
    every_fourth = range(0, len(recording.times), 4)
    return recording.frames(every_fourth).select(
        [f"{joint}.rx" for joint in JOINTS]
    )


def with_gap(
    recording: Recording, rng: np.random.Generator
) -> Recording:
    """Hide some frames in a row, somewhere between the ends."""
    start = rng.integers(10, len(recording.times) - GAP - 10)
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[start : start + GAP] = True
    return recording.hide(hidden)


others = [walk(person) for person in (2, 3, 4, 5)]
truth = [walk(person) for person in range(6, 14)]
rng = np.random.default_rng(0)
given = [with_gap(recording, rng) for recording in truth]

# %%
# Three models
# ------------
#
# - ``makima`` draws a smooth curve through the frames on either side.
#   It has no interval.
# - ``gp-independent`` is one Gaussian process for each joint. It knows
#   how fast a joint moves, and nothing of other joints or other people.
#   ``Calibrated`` checks its intervals where the truth is visible.
# - ``pose-kriging`` looks for similar poses in the walks of other
#   people, and corrects them.
#
# An ``ImputeProblem`` holds what models see, and apart from it the
# truth, for the scores.

from mocapbench.baselines import (
    Calibrated,
    GPIndependent,
    MakimaImputer,
    PoseKriging,
)
from mocapbench.benchmark import ImputeProblem, Unit

MODELS = {
    "makima": MakimaImputer(),
    "gp-independent": Calibrated(GPIndependent()),
    "pose-kriging": PoseKriging(),
}

problem = ImputeProblem(
    train=(*others, *given),
    given=tuple(given),
    truth=tuple(recording.values for recording in truth),
    unit=Unit.natural(len(JOINTS)),  # score in degrees
)
solutions = {
    name: problem.solve(model.fit(problem.train), random_state=0)
    for name, model in MODELS.items()
}

# %%
# The curve and its interval
# --------------------------
#
# **Look at** the dashed line, which is the truth. Does the filled curve
# follow it? Do the intervals hold it? The dark one should hold half of
# the hidden values, the light one 95 % of them.

PERSON, KNEE = 0, JOINTS.index("ltibia")

# sphinx_gallery_start_ignore
plt.style.use(["seaborn-v0_8-whitegrid", "tableau-colorblind10"])

times, knee = truth[PERSON].times, truth[PERSON].values[:, KNEE]
hidden = ~given[PERSON].visible[:, KNEE]
gap = times[hidden][[0, -1]]

figure, axes = plt.subplots(
    3,
    1,
    figsize=(6.4, 6.6),
    sharex=True,
    sharey=True,
    layout="constrained",
)
for axis, (name, solution) in zip(axes, solutions.items(), strict=True):
    prediction = solution[PERSON]
    mean = prediction.mean[:, KNEE]
    if prediction.variance is not None:
        sd = np.sqrt(prediction.variance[:, KNEE])
        for share, opacity in ((0.95, 0.25), (0.5, 0.5)):
            reach = norm.ppf(0.5 + share / 2) * sd
            axis.fill_between(
                times,
                mean - reach,
                mean + reach,
                color="C0",
                alpha=opacity,
                lw=0,
                label=f"{share:.0%} interval",
            )
    axis.plot(times, mean, color="C0", label="filled")
    axis.plot(times, knee, "--", color="black", lw=1.2, label="truth")
    axis.set(title=name, ylabel="left knee (°)")
axes[0].set_xlim(gap[0] - 0.4, gap[1] + 0.4)
axes[-1].legend(loc="lower right", ncols=2, frameon=True)
axes[-1].set_xlabel("time (s)")
plt.show()
# sphinx_gallery_end_ignore

# %%
# ``makima`` says nothing of its doubt. ``gp-independent`` does, and its
# intervals are widest in the middle of the gap, where the nearest seen
# frame is far away.
#
# Can the intervals be believed?
# ------------------------------
#
# One gap in one joint is an anecdote. Over all gaps and joints,
# **coverage** counts how many hidden values lie within an interval. A
# 95 % interval with a coverage of 60 % is too narrow: the model is
# surer than it should be. With more than 95 % it is wider than it need
# be.

from mocapbench.metrics import (
    coverage_50,
    coverage_80,
    coverage_90,
    coverage_95,
    mse,
    sharpness,
)

COVERAGES = {
    0.5: coverage_50,
    0.8: coverage_80,
    0.9: coverage_90,
    0.95: coverage_95,
}

covered = {}
print(f"{'':16}{'error':>9}{'mean sd':>11}{'in the 95 % interval':>24}")
for name, solution in solutions.items():
    outcome = problem.outcome(solution)
    line = f"{name:16}{np.sqrt(mse(outcome).value):7.1f} °"
    if outcome.variance is not None:
        covered[name] = [
            metric(outcome).value for metric in COVERAGES.values()
        ]
        mean_sd, within = sharpness(outcome).value, covered[name][-1]
        line += f"{mean_sd:9.1f} °{within:24.0%}"
    print(line)

# %%
# The error is the root of the mean squared error over all hidden
# values. **Look at** which points lie below the diagonal in the
# picture: those intervals hold fewer values than they promise.

promised = 100 * np.array(list(COVERAGES))

# sphinx_gallery_start_ignore
figure, axis = plt.subplots(figsize=(5.2, 4.6), layout="constrained")
axis.plot([40, 100], [40, 100], color="C3", lw=1, label="as promised")
for (name, shares), marker, color in zip(
    covered.items(), "os", ("C1", "C0"), strict=True
):
    axis.plot(
        promised,
        100 * np.array(shares),
        marker=marker,
        color=color,
        label=name,
    )
axis.set(
    xlabel="promised by the interval (%)",
    ylabel="hidden values within it (%)",
    title="Above the line: too wide; below: too narrow",
)
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# The values of one gap go together: where a curve goes astray, it does
# so for many frames. So eight gaps tell less than their many values
# suggest: 93 % and 97 % would be no different here.
#
# The same from the command line
# ------------------------------
#
# Your own recordings are files. Here we write a walk with its gap and
# two walks to learn from as CSV files, whose columns name the unit in
# brackets.

import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd

folder = TemporaryDirectory()


def write_csv(recording: Recording, name: str) -> None:
    """Write times and channels; hidden values are empty."""
    columns = [f"{channel} [deg]" for channel in recording.channels]
    table = pd.DataFrame(recording.values, columns=columns)
    table.insert(0, "time", recording.times)
    table.to_csv(Path(folder.name, name), index=False)


write_csv(given[PERSON], "walk.csv")
write_csv(others[0], "other-1.csv")
write_csv(others[1], "other-2.csv")

command = (
    "mocapbench fill walk.csv --train other-1.csv --train other-2.csv"
    " --model pose-kriging --out filled"
)
done = subprocess.run(
    command.split(),
    cwd=folder.name,
    check=True,
    capture_output=True,
    text=True,
)
print("$", command)
print(done.stdout)

# %%
# ``filled/walk.csv`` is the walk without its gap. The table beside it
# has the mean and the standard deviation (``sd``) of every value that
# was filled in; the mean ± 1.96 sd is the 95 % interval.

entries = pd.read_csv(
    Path(folder.name, "filled", "walk.csv.entries.csv")
)
print(entries.head(8).to_string(index=False))
folder.cleanup()

# %%
# Without ``--model``, every model that can fill these gaps is tried on
# gaps like them, and the best one fills. That is the better choice for
# motions that nobody has tried before.
#
# Where next
# ----------
#
# - :doc:`/filling`: all options of ``mocapbench fill``, and how well it
#   chooses a model.
# - :doc:`/calibration`: the intervals of models on real recordings.
# - :doc:`/generated/models/pose-kriging` and
#   :doc:`/generated/models/gp-independent`: how they work.
# - :doc:`plot_2_add_a_model`: a model of your own.
# - :doc:`plot_3_what_a_hierarchy_buys`: why other people's walks help.
