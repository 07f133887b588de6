"""The joints whose coregionalisation Figures 15 and 16 of the thesis show."""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["JOINT_GROUPS"]

JOINT_GROUPS: Mapping[str, tuple[str, ...]] = {
    "left leg": ("lfemur", "ltibia", "lfoot"),
    "head and left femur": ("head", "lfemur"),
}
