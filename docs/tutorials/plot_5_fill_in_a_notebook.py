"""
Fill and compare in a notebook
==============================

Your recording is a table, an array or a dataset of xarray, and you
want its gaps closed where you work: in a notebook. You learn to fill
it, to see how sure each value is, to score models on gaps of your own
choice, and to put a model into a pipeline of scikit-learn.
"""

# %%
# A recording that is no file
# ---------------------------
#
# Here it is a generated walk as a table: a row a frame, indexed by the
# time in seconds, and a column a channel, whose unit stands in
# brackets. The left leg is lost for half a second: NaN is hidden.

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

import mocapbench
from mocapbench import GapFiller, Gaps
from mocapbench.datasets import GaitLibrary

truth = GaitLibrary().recording("06_01")
truth = truth.frames(range(0, len(truth.times), 4))
table = pd.DataFrame(
    truth.values,
    index=truth.times,
    columns=[f"{channel} [deg]" for channel in truth.channels],
)
leg = [name for name in table if name.startswith(("lfemur", "ltibia"))]
table.loc[table.index[30:45], leg] = np.nan

# %%
# An array needs its rate, and names: ``read(values, rate=30,
# names=[...])``. A dataset of *movement* and a file, as in
# ``read("walk.c3d")``, have both.
#
# Fill it
# -------
#
# Without a name, ``fill`` chooses the model that errs least in copies
# of the gap, as the command does, to the bit. A model that is named
# fills at once.

walk = mocapbench.read(table)
filled = mocapbench.fill(walk, effort="low")
filled.ranking.head()

# %%
# Every gap has a row: what filled it, and what makes it doubtful.

filled.gaps[["marker", "first", "last", "model", "error", "caution"]]

# %%
# **Look at** the blue line beside the dashed one, which is the truth
# and which no model has seen, and at whether the interval holds it.

filled = mocapbench.fill(walk, "channel-kriging")
axes = filled.plot("ltibia", truth=mocapbench.read(truth))

# sphinx_gallery_start_ignore
plt.show()
# sphinx_gallery_end_ignore

# %%
# The values are at hand: ``filled.recording``, ``filled.std``,
# ``filled.interval(0.95)``, ``filled.to_dataframe()``. What was read
# from a file is written like it by ``filled.save("filled.c3d")``.
#
# Which model is best for gaps like these?
# ----------------------------------------
#
# ``evaluate`` hides gaps where the seed says, has every model fill
# them, and scores it. A model of your own and an imputer of
# scikit-learn stand beside ours.

from sklearn.impute import KNNImputer

scores = mocapbench.evaluate(
    [mocapbench.read(truth)],
    models=["linear", "channel-kriging", KNNImputer()],
    hide=Gaps(seconds=0.2, what="limb", count=8),
)
scores.pivot_table(values="value", index="metric", columns="model")

# %%
# Is the difference more than chance? Gaps that share frames count as
# one.

compared = mocapbench.compare(scores)
errors = compared[compared["metric"] == "mse"]
errors[["first", "second", "n", "p_holm", "verdict"]]

# %%
# In a pipeline
# -------------
#
# ``GapFiller`` is a transformer of scikit-learn for arrays with NaN.

from sklearn.decomposition import PCA
from sklearn.pipeline import make_pipeline

pipeline = make_pipeline(GapFiller("pchip", rate=30), PCA(2))
postures = pipeline.fit_transform(walk.values)
print(postures.shape, np.isnan(postures).any())

# %%
# Where next
# ----------
#
# - :doc:`/filling`: how a model is chosen, and how good the choice is.
# - :doc:`/api/mocapbench`: all that a notebook can call.
# - :doc:`plot_2_add_a_model`: a model of your own.
# - :doc:`plot_4_is_the_difference_real`: what the tests assume.
