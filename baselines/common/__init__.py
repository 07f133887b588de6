"""Helpers that more than one family of models uses.

* `validation`, `checks`: checks of parameters and of recordings; `cycle_settings`: checks of what
  all models of cycles have;
* `recordings`: several of them together, their complete frames, and lines across their gaps;
* `heading`: where a motion faces;
* `scaling`, `pose_units`: units in which channels count alike; `padded_sequences`: arrays of all;
* `markers`, `rigid`: channels that are coordinates of markers, and how these move together;
* `ascent`: steps that raise an objective; `shortest_path`, `transitions`: paths of frames;
* `prototypes`: recordings grouped by their cycles; `signs`: of eigenvectors;
* `cholesky`: linear algebra.
"""
