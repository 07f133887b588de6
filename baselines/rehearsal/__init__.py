"""Gaps where the truth is visible, and what a model's errors there say of its variances.

* `checkable`: models whose variances can be checked, and those that learn anew for it;
* `trials`: more of the recording to fill is hidden, like its gaps;
* `stand_ins`: training recordings that take its place; `in_training`: how claims stand up there;
* `lost_channels`: channels that are hidden throughout;
* `ratios`: by how much squared errors exceed claimed variances;
* `variance_check`, `widening`: what trials say of variances, and these so multiplied;
* `rehearsing`: what trials and training recordings say together;
* `left_out`: what visible entries say that are left out one by one; `calibrated_posteriors`: what
  they and trials say together of a process that knows the recordings.
"""
