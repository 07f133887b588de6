"""Gaussian-process regression over frames (kriging).

Whole frames:

* `conditioned`: a process given its values at visible frames; `student`: how much wider a scale
  that is inferred makes it; `own_course`: one over time alone; `beside_gaps`: gaps filled by it;
* `paths`: training recordings matched with a new one; `symmetry`: the mirror image of a motion.

Channels of a frame:

* `stacked`: the frames of several recordings; `left_out`: errors in recordings left out.

Markers:

* `local_frames`: bodies that move with markers; `marker_gap`: a gap of a marker seen from one;
* `marker_process`: the process of where it is; `left_out_gaps`: errors in gaps left out.
"""
