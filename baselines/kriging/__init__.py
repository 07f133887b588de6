"""Gaussian-process regression over frames (kriging).

Whole frames:

* `conditioned`: a process given its values at visible frames; `student`: how much wider a scale
  that is inferred makes it; `own_course`: one over time alone; `beside_gaps`: gaps filled by it;
* `paths`: training recordings matched with a new one; `symmetry`: the mirror image of a motion;
  `mirrored_residuals`: the processes of what a path leaves unexplained, and of its mirror image.

Processes whose parameters predict best what is left out:

* `left_out_gaps`: errors in gaps that are left out; `learning`: the search for the parameters;
* `stacked`: the frames of several recordings, and which channels say most of others;
  `channel_pairs`, `channel_process`: the process of channels that others show;
* `local_frames`: bodies that move with markers; `marker_gap`: a gap of a marker seen from one;
  `marker_process`: the process of where it is.
"""
