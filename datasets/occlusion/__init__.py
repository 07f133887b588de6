"""Which markers are hidden in which frames: the masks of a paper, and the gaps of real files.

* `fixed_masks`: those that D. H. Kieu and others publish, with the errors that they print;
* `real_gaps`: how long gaps are in files of laboratories, and how many of them overlap.
"""
