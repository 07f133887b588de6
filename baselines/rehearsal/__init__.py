"""Gaps where the truth is visible, and what a model's errors there say of its variances.

* `trials`: more of the recording to fill is hidden, like its gaps;
* `stand_ins`: training recordings that take its place;
* `ratios`: by how much squared errors exceed claimed variances;
* `variance_check`, `widening`: what trials say, and models that learn from it;
* `rehearsing`: what trials and training recordings say together.
"""
