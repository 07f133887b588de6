"""
Add a model and see where it stands
===================================

You have an idea of how to fill gaps. You write it as a model in
twenty lines, check that it keeps the rules, run it beside others on
the same gaps, and read where it stands.
"""

# %%
# The idea
# --------
#
# People move smoothly: reaching hands follow the path of `least jerk
# <https://doi.org/10.1523/JNEUROSCI.05-07-01688.1985>`_, which is the
# third derivative of position. So let each channel go through a gap
# with the least sum of squared third differences. That is one
# least-squares problem for each channel.
#
# The model
# ---------
#
# A model is a class that inherits what it can do. This one is
#
# - an ``Interpolator``: it fills any set of hidden entries, each
#   channel from its own course alone;
# - ``Inductive``: it also fills recordings that it has not seen in
#   ``fit``.
#
# It stands in a file,
# :download:`my_model.py </tutorials/code/my_model.py>`, with a
# dictionary ``MODELS``, which gives it a name. If you run this tutorial
# as a script, put the file into a folder ``code`` beside it.
#
# .. literalinclude:: /tutorials/code/my_model.py
#    :language: python
#    :caption: my_model.py
#
# ``Prediction.around`` keeps what is seen, and takes the filled values
# for the rest. A model with a predictive variance would give it as a
# third argument.
#
# Does it keep the rules?
# -----------------------
#
# The conformance kit feeds a model short recordings, channels without a
# value, recordings in another order and more. It raises a
# ``ConformanceError`` that says what was expected and what to do. We
# try it on a model with a mistake, which forgets to keep what is seen,
# and on ours.

import sys
from pathlib import Path
from textwrap import fill

import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.benchmark.testing import ConformanceError, check_model

PLUGIN = Path("code", "my_model.py").resolve()
sys.path.append(str(PLUGIN.parent))
from my_model import LeastJerk


class Forgetful(LeastJerk):
    """Fill everything with zeros, also what is seen."""

    def impute(self, recordings):
        return [
            Prediction(np.zeros(recording.values.shape))
            for recording in recordings
        ]


for model in (Forgetful, LeastJerk):
    try:
        check_model(model)
        print(f"{model.__name__} conforms")
    except ConformanceError as error:
        print(fill(str(error), width=72))

# %%
# Run it beside others
# --------------------
#
# The task :doc:`/generated/tasks/marker-gaps` hides an arm or a leg for
# 0.1 to 2 seconds. We take its generated walks, six folds (each with
# another gap), and three interpolations to compare with. Each job runs
# in a process of its own and never sees the truth.

import subprocess
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
    f"mocapbench run --plugin {PLUGIN} --out results"
    " --offline --no-report --tasks marker-gaps"
    " --cases 'synthetic*alone' --folds 6"
    " --models least-jerk,linear,makima,cubic-spline"
)
print(output.splitlines()[-2])

# %%
# Where it stands
# ---------------
#
# Without ``--no-report``, the run ends with a page,
# ``results/report.html``, which begins with a scoreboard. Here we draw
# our own from the table of all scores.

import matplotlib.pyplot as plt
import pandas as pd

run("mocapbench export results")
scores = pd.read_csv(Path(folder.name, "results", "scores.csv"))
errors = scores[scores.metric == "mpjpe"]
errors = errors.assign(
    gap=errors.case.str.extract(r"([\d.]+) s")[0].astype(float)
)
board = errors.pivot_table(index="label", columns="gap", values="value")
board = board.loc[board.rank().mean(axis=1).sort_values().index]

times_worse = (board / board.min()).to_numpy()

# sphinx_gallery_start_ignore
plt.style.use("tableau-colorblind10")
figure, axis = plt.subplots(figsize=(6.4, 2.8), layout="constrained")
axis.imshow(
    np.log(times_worse),
    cmap="cividis_r",
    aspect="auto",
    vmin=0.0,
    vmax=np.log(4.0),
)
for (row, column), worse in np.ndenumerate(times_worse):
    color, weight = (
        ("white" if worse > 2.0 else "black"),
        ("bold" if worse == 1.0 else "normal"),
    )
    text = f"{board.iat[row, column]:.2f}"
    axis.text(
        column,
        row,
        text,
        ha="center",
        va="center",
        color=color,
        weight=weight,
    )
axis.set_xticks(
    range(len(board.columns)), [f"{gap:g} s" for gap in board.columns]
)
axis.set_yticks(range(len(board)), board.index)
axis.set(
    xlabel="length of the gap",
    title="Mean error of joint positions (cm); bold: the best",
)
plt.show()
# sphinx_gallery_end_ignore

# %%
# **Look at** one row at a time, from left to right. The darker a cell
# is in its column, the more times its error is that of the best. A
# smooth course is a good guess for as long as a movement goes on; over
# a longer gap, a leg has taken a step that no curve between the two
# ends shows.

best = board.idxmin()
for length, label in best.items():
    worst = times_worse[:, board.columns.get_loc(length)].max()
    print(
        f"gaps of {length:g} s: {label} is best, "
        f"the last one is {worst:.1f} times worse"
    )

# %%
# Is that more than chance?
# -------------------------
#
# Six gaps of each length are few. ``mocapbench compare`` pairs the two
# models gap by gap. We take the interpolation that stands highest in
# the picture.

rival = next(label for label in board.index if label != "least-jerk")
pair = f"least-jerk,{rival}"
command = f"mocapbench compare results --models {pair} --metrics mpjpe"
print("$", command)
run(f"{command} --plugin {PLUGIN} --csv compared.csv")

compared = pd.read_csv(Path(folder.name, "compared.csv"))
compared["case"] = compared.case.str.replace(
    ", this recording alone", ""
)
columns = ["case", "n", "advantage", "low", "high", "t_p_holm"]
print(compared[columns].round(2).to_string(index=False))
folder.cleanup()

# %%
# Without ``--csv`` the same stands in the terminal, with an outcome in
# words. **Look at** the column *advantage*, in centimetres: above zero,
# the new model is better. Its 95 % interval goes from *low* to *high*;
# one that holds 0 leaves open which of the two is better, and so does a
# *p* above 0.05. *All cases* has all gaps, of every length.
# :doc:`plot_4_is_the_difference_real` says what lies behind these
# columns, and how many folds it takes.
#
# Where next
# ----------
#
# - :doc:`plot_4_is_the_difference_real`: from a difference to a claim.
# - :doc:`/compare`: the guide to models, tasks and metrics of your own,
#   and how to publish them.
# - :doc:`/own-recordings`: the same contest on your recordings.
# - :doc:`/ci`: have a test fail when your model gets worse.
# - :doc:`/generated/tasks/index`: more to take part in.
