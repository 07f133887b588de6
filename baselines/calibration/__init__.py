"""How wide intervals have to be, learnt from gaps where the truth is known.

`mocapbench.baselines.Calibrated` wraps a model and multiplies its variances by what these say.

* `held_out_gaps`: copies of a recording's gaps, where it is visible;
* `held_out_recordings`: training recordings that take the place of the one to fill;
* `error_ratios`: by how much squared errors exceed predicted variances;
* `variance_check`: what held-out gaps say of the variances of a recording;
* `left_out_entries`: what its visible entries say, each predicted from all others;
* `ways`: from both to calibrated predictions, in the way that suits the model.
"""
