"""Models that continue recordings: from the last few frames seen to the next ones.

* `windows`: what is learnt from, and the class of models that learn from it;
* `velocity`, `ridge`, `neighbours`, `window_process`: one model each.
"""
