"""Gaussian-process regression over frames (kriging).

Whole frames:

* `conditioned`: a process given its values at visible frames; `own_course`: one over time alone;
* `frame_rates`: 30 frames per second, and all frames again;
* `paths`: training recordings matched with a new one; `mirror_images`: the mirror image of a
  motion, and the processes of what a path leaves unexplained of both.

Processes whose parameters best predict what is held out:

* `described_frames`: frames by what is seen in each, and which of them count;
* `held_out_stretches`: errors in frames that are held out, and the search for the parameters;
* `stacked`: the frames of several recordings, and which channels say most of others;
  `channel_process`: the process of channels that others show; `stances`: where markers stand and
  face, taken out before;
* `body`: a body that moves with markers; `marker_gap`: a gap of a marker, seen from it;
  `marker_process`: the process of where it is.
"""
