"""Gaussian-process regression over frames (kriging).

* `conditioned`: a process given its values at visible frames; `own_course`: one over time alone;
* `paths`: training recordings matched with a new one;
* `symmetry`: the mirror image of a motion;
* `stacked`: the frames of several recordings.
"""
