"""Synthetic gait: recordings of a procedural walker, made on demand.

With them every task runs on a machine that has no recordings and no network. Results computed on
them must be labelled *synthetic*.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.acclaim.skeleton_reader import read_skeleton
from mocapbench.datasets.generated.gait_walker import ARMS, LEGS, walk
from mocapbench.datasets.keys import split_key
from mocapbench.datasets.library import Library
from mocapbench.datasets.recording import Recording

__all__ = ["GAIT_VERSION", "GaitLibrary", "gait_style"]

GAIT_VERSION = 1
"""To be increased whenever a change of the code gives the same key another motion."""

_BODY = 1000
"""In place of a trial, in the seed of a body."""

_STYLE_OF_TRIAL = ("walk", "walk", "slow walk", "stride", "run")


def gait_style(key: str) -> str:
    """Return the style of a recording: ``"walk"``, ``"slow walk"``, ``"stride"`` or ``"run"``.

    The trials of a subject cycle through walk, walk, slow walk, stride and run.

    Raises
    ------
    ValueError
        If the key is malformed.
    """
    _, trial = split_key(key)
    return _STYLE_OF_TRIAL[(int(trial) - 1) % len(_STYLE_OF_TRIAL)]


class GaitLibrary(Library):
    """Synthetic recordings by key, ``SUBJECT_TRIAL``; every such key names one.

    Subjects 01 to 99 share one skeleton; from 100 on, each has proportions of their own.

    Parameters
    ----------
    *folders : path
        Not used: recordings are generated.

    Examples
    --------
    >>> from mocapbench.datasets import GaitLibrary
    >>> library = GaitLibrary()
    >>> library.where("03_05")
    'generated'
    >>> library.recording("03_05").values.shape
    (301, 62)
    """

    def where(self, key: str) -> str:
        """Return ``"generated"``."""
        split_key(key)
        return "generated"

    def recording(self, key: str) -> Recording:
        """Return all 62 channels of the motion."""
        return _recording(key)

    def motion(self, key: str) -> Motion:
        """Return the motion; as Acclaim text it would have the same values."""
        subject, trial = map(int, split_key(key))
        skeleton = self.skeleton(key)
        return walk(skeleton, gait_style(key), subject, trial)

    def skeleton(self, key: str) -> Skeleton:
        """Return the skeleton of the subject."""
        subject, _ = split_key(key)
        shared = read_skeleton(Path(__file__).with_name("gait.asf"))
        return shared if len(subject) == 2 else _grow_body(shared, int(subject))

    def digest(self, key: str) -> str:
        """Return generator version and key, which determine the recording."""
        split_key(key)
        return f"gait-{GAIT_VERSION}:{key}"


def _grow_body(skeleton: Skeleton, subject: int) -> Skeleton:
    """Return a skeleton of another stature, with other legs, arms and trunk; the same on sides."""
    rng = np.random.default_rng([subject, _BODY])
    stature = rng.normal(1.0, 0.06)
    factors = {kind: stature * rng.normal(1.0, 0.04) for kind in ("legs", "arms", "trunk")}
    segments = tuple(
        replace(segment, length=segment.length * factors[_kind_of(segment.name)])
        for segment in skeleton.segments
    )
    return replace(skeleton, segments=segments)


def _kind_of(segment: str) -> str:
    if segment.endswith((*LEGS, "hipjoint")):
        return "legs"
    return "arms" if segment.endswith(ARMS) else "trunk"


@cache  # a walk takes longer to make than most models to fit, and cannot be changed
def _recording(key: str) -> Recording:
    return GaitLibrary().motion(key).recording(key)
