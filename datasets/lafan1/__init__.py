"""The data set LaFAN1 of F. G. Harvey and others (2020): its file, rotations, and windows.

* `hierarchy`: joints and offsets of a BVH file;
* `takes`: the recordings in the file ``lafan1.zip``, which a user has;
* `unit_quaternions`: products of rotations, and the joints that they place;
* `windows`: stretches of takes that begin at the same place and face the same way.
"""
