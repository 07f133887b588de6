"""Synthetic gait: recordings of a procedural walker, made on demand.

They let every task run on a machine with no data and no network. What is computed on them must be
labelled *synthetic*.
"""

from __future__ import annotations

from pathlib import Path

from mocapbench.datasets.acclaim.motion import Motion, format_motion
from mocapbench.datasets.acclaim.motion_reader import parse_motion
from mocapbench.datasets.acclaim.skeleton_reader import read_skeleton
from mocapbench.datasets.gait_curves import STYLES
from mocapbench.datasets.gait_walker import walk
from mocapbench.datasets.library import Library, split_key

__all__ = ["GAIT_VERSION", "GaitLibrary", "gait_style"]

GAIT_VERSION = 1
"""Raised whenever the same key would give another motion."""

_STYLE_OF_TRIAL = ("walk", "walk", "slow walk", "stride", "run")


def gait_style(key: str) -> str:
    """Return the style of a recording: trials go through walk (twice), slow walk, stride, run."""
    _, trial = split_key(key)
    return _STYLE_OF_TRIAL[(int(trial) - 1) % len(_STYLE_OF_TRIAL)]


class GaitLibrary(Library):
    """Synthetic recordings by key, ``SUBJECT_TRIAL``; every key names one."""

    def where(self, key: str) -> str:
        """Return ``generated``."""
        split_key(key)
        return "generated"

    def read(self, key: str) -> Motion:
        """Return the motion, written and read back as Acclaim text like any other."""
        skeleton = read_skeleton(Path(__file__).with_name("gait.asf"))
        motion = walk(skeleton, STYLES[gait_style(key)], *map(int, split_key(key)))
        return parse_motion(format_motion(motion), skeleton, f"gait:{key}")

    def digest(self, key: str) -> str:
        """Return generator version and key, from which the bytes follow."""
        split_key(key)
        return f"gait-{GAIT_VERSION}:{key}"

    def fetch(self, key: str) -> None:
        """Do nothing: the recording is made on demand."""
        split_key(key)
