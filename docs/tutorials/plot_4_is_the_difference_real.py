"""
Is the difference real?
=======================

The error of one model is a tenth below that of another. Is it better,
or was it lucky with its gaps? You compare models gap by gap, then
several at once, and find out how many gaps a claim needs.
"""

# %%
# A run
# -----
#
# Five models fill an arm or a leg that is hidden for half a second.
# Each of twelve *folds* hides another one. The walks are generated
# (:doc:`/generated/tasks/marker-gaps` has the real ones).

import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

folder = TemporaryDirectory()


def run(command: str) -> str:
    """Return what a command prints."""
    done = subprocess.run(
        command,
        shell=True,
        cwd=folder.name,
        check=True,
        capture_output=True,
        text=True,
    )
    return done.stdout


output = run(
    "mocapbench run --out results --offline --no-report"
    " --tasks marker-gaps --folds 12"
    " --cases 'synthetic a limb 0.5 s*others*'"
    " --models low-rank,pca-regression,cubic-spline,makima,linear"
)
print(output.splitlines()[-2])

# %%
# The scores of a run are a table: a row for each fold, a column for
# each model. These are mean errors of joint positions in centimetres.

import pandas as pd

from mocapbench.benchmark import RunDirectory, score_table

results = RunDirectory(Path(folder.name, "results"))
scores = score_table(results.planned())
errors = scores[scores.metric == "mpjpe"].pivot_table(
    index="fold", columns="label", values="value"
)
errors = errors[errors.mean().sort_values().index]  # the best first
print(errors.round(2).to_string())

# %%
# **Look along** the rows: folds differ in how hard they are, for all
# models alike. Two models must therefore be compared on the *same*
# fold, and what counts is the difference.
#
# Two models
# ----------
#
# ``mocapbench compare`` does so. **Look at** the *advantage*, in
# centimetres, and its 95 % interval from *low* to *high*. If it holds
# 0, these folds do not tell which of the two is better.

best, second = errors.columns[:2]
pair = f"{best},{second}"
command = f"mocapbench compare results --models {pair} --metrics mpjpe"
print("$", command)
run(f"{command} --csv compared.csv")

compared = pd.read_csv(Path(folder.name, "compared.csv"))
columns = ["n", "first", "second", "advantage", "low", "high"]
columns += ["t_p", "better", "equivalent", "worse"]
print(compared[columns].round(2).T.to_string(header=False))
folder.cleanup()

# %%
# Without ``--csv`` the same stands in the terminal. ``t_p`` is the
# p-value of the paired t-test. One above 0.05 does not mean that the
# models are equal. It means that nobody knows yet. The last three rows
# say how probable it is that the first is better, that both are
# equivalent (less than 2 % apart), and that it is worse.
#
# All against the best
# --------------------
#
# With five models there are four such comparisons, and each may err.
# **Holm's correction** makes the intervals wider so that all four
# together raise a false alarm in about 5 % of runs. (It is a little
# more, since the best is chosen on the same folds:
# :doc:`/mathematics/error-rates` counts it.)
#
# **Look at** the dashed line. A model whose bar reaches it may be as
# good as the best.

import matplotlib.pyplot as plt
import numpy as np

from mocapbench.metrics.statistics import (
    friedman,
    group_ranks,
    holm_tests,
    mean_ranks,
    nemenyi,
)

rest = errors.columns[1:]
behind = np.array([errors[label] - errors[best] for label in rest])
tests = holm_tests(behind)
for label, mean, p in zip(rest, tests["mean"], tests.p, strict=True):
    verdict = "behind" if p <= 0.05 else "may be chance"
    print(f"{label:16}{mean:6.2f} cm, p = {p:.2g}: {verdict}")

# sphinx_gallery_start_ignore
plt.style.use(["seaborn-v0_8-whitegrid", "tableau-colorblind10"])
figure, axis = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for row, differences in enumerate(behind):
    axis.plot(
        differences,
        np.full(len(differences), row),
        "o",
        color="C3",
        ms=4,
        alpha=0.6,
    )
axis.hlines(range(len(rest)), tests.low, tests.high, color="C0", lw=4)
axis.plot(tests["mean"], range(len(rest)), "D", color="C1", ms=7)
axis.plot([], [], "o", color="C3", ms=4, label="a fold")
axis.plot([], [], color="C0", lw=4, label="interval")
axis.plot([], [], "D", color="C1", label="mean")
axis.axvline(0.0, color="black", ls="--", lw=1)
axis.set_yticks(range(len(rest)), rest)
axis.set_ylim(len(rest) - 0.5, -0.5)
axis.set(xlabel=f"error above that of {best} (cm)")
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# Ranks
# -----
#
# A mean is moved by one bad fold. A rank is not: 1 for the best of a
# fold, 5 for the worst. Mean ranks that differ by less than the
# *critical difference* are not separable.
#
# **Look at** the bars: each joins models that nobody can tell apart by
# their ranks.

ranks, difference = mean_ranks(errors), nemenyi(*errors.shape)
for label, rank in zip(errors.columns, ranks, strict=True):
    print(f"{label:16}mean rank {rank:.2f}")
print(f"critical difference {difference:.2f}")

# sphinx_gallery_start_ignore
figure, axis = plt.subplots(figsize=(6.4, 2.6), layout="constrained")
axis.plot(ranks, np.zeros(len(errors.columns)), "o", color="C1")
for label, rank in zip(errors.columns, ranks, strict=True):
    axis.annotate(
        label,
        (rank, 0.0),
        (0, 8),
        textcoords="offset points",
        rotation=25,
    )
groups = group_ranks(ranks, difference, friedman(errors))
for height, group in enumerate(groups, 1):
    ends = [ranks[model] for model in (group[0], group[-1])]
    axis.hlines(-0.3 * height, *ends, color="C0", lw=4)
axis.set(
    xlim=(0.8, 5.4),
    ylim=(-0.3 * len(groups) - 0.3, 1.4),
    yticks=[],
)
axis.set_xlabel(f"mean rank over {len(errors)} folds")
plt.show()
# sphinx_gallery_end_ignore

# %%
# False alarms
# ------------
#
# What if all models were equally good? We draw differences that are
# nothing but chance, a thousand times, and count how often a test
# claims that somebody is behind.
#
# **Look at** the two curves on the right. Without a correction,
# somebody is often called behind for no reason.

rng = np.random.default_rng(0)
NUMBERS = (1, 2, 4, 6, 9)
shares = {"each test at 5 %": [], "with Holm's correction": []}
for n_tests in NUMBERS:
    families = [
        holm_tests(rng.standard_normal((n_tests, 12)))
        for _ in range(1000)
    ]
    shares["each test at 5 %"].append(
        np.mean([t.uncorrected_p.min() < 0.05 for t in families])
    )
    shares["with Holm's correction"].append(
        np.mean([t.p.min() < 0.05 for t in families])
    )

# sphinx_gallery_start_ignore
figure, axis = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (name, values), marker, color in zip(
    shares.items(), "so", ("C1", "C0"), strict=True
):
    axis.plot(
        NUMBERS,
        100 * np.array(values),
        marker=marker,
        color=color,
        label=name,
    )
axis.axhline(5.0, color="C3", ls="--", lw=1)
axis.set(
    xlabel="comparisons",
    ylabel="runs with a false alarm (%)",
    ylim=(0, None),
)
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# How many folds does it take?
# ----------------------------
#
# That depends on how much folds scatter, which the run has shown. We
# take the differences of the two best models, move their mean to a true
# lead of 10, 20 or 40 % of the error, draw new sets of folds from them,
# and count how often the test sees the lead.
#
# **Look at** where a curve crosses 80 %, which is the usual aim.

differences = (errors[second] - errors[best]).to_numpy()
scatter = differences - differences.mean()
N_FOLDS = np.array([3, 5, 8, 12, 20, 30, 50, 80, 120])


def power(lead: float, n_folds: int) -> float:
    """Return how often 1000 runs of so many folds see a lead."""
    drawn = rng.choice(scatter, size=(1000, n_folds))
    tests = holm_tests(drawn + lead * errors[best].mean())
    return float(np.mean(tests.uncorrected_p < 0.05))


powers = {
    lead: np.array([power(lead, n_folds) for n_folds in N_FOLDS])
    for lead in (0.1, 0.2, 0.4)
}
for lead, seen in powers.items():
    enough = N_FOLDS[seen >= 0.8]
    answer = enough[0] if len(enough) else f"more than {N_FOLDS[-1]}"
    print(f"lead of {lead:.0%}: {answer} folds see it in 4 of 5 runs")

# sphinx_gallery_start_ignore
figure, axis = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for (lead, seen), style in zip(
    powers.items(), ("C0-o", "C1-s", "C3-^"), strict=True
):
    axis.plot(N_FOLDS, 100 * seen, style, label=f"lead of {lead:.0%}")
axis.axhline(80.0, color="black", ls="--", lw=1)
axis.set(xscale="log", xlabel="folds", ylabel="leads that are seen (%)")
axis.set_ylim(0, 102)
axis.set_xticks(N_FOLDS, N_FOLDS)
axis.minorticks_off()
axis.legend(frameon=True)
plt.show()
# sphinx_gallery_end_ignore

# %%
# Two warnings. Folds must be *independent*: many windows of one
# recording are one witness who is asked many times. And the number of
# folds is chosen before the run: who adds folds until a test agrees
# will have it agree.
#
# Where next
# ----------
#
# - :doc:`/mathematics/statistics`: which test is used where, and why.
# - :doc:`/ci`: the regression gate, which asks whether a metric got
#   worse, and how often it errs.
# - :doc:`/compare`: compare your model with others.
# - :doc:`plot_1_fill_a_recording`: look at the fills themselves.
