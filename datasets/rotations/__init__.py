"""Recordings as rotation vectors, as contests of motion prediction have them.

* `body`: the 38 joints, their offsets, and their positions;
* `library`: the files that a user names, or the recordings of the CMU database in their place;
* `recipe`: rotation vectors from joint angles.
"""
