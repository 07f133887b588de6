"""Joint-angle curves of one cycle of human walking, as short Fourier series, and gait styles.

The curves approximate the normal sagittal curves of gait analysis (Perry & Burnfield, *Gait
Analysis*, 2010). Phase 0 is the strike of the left heel, and a curve is

    x(φ) = offset + Σ_k a_k cos(k φ + p_k).

Curves of limbs (``femur.rx``) are given for the left side; the right side runs half a cycle later,
mirrored.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["ARMS", "CURVES", "LEGS", "STYLES", "Curve", "Style"]

Curve = tuple[float, tuple[tuple[float, float], ...]]
"""Offset in degrees, and amplitude (degrees) and phase (radians) of each harmonic."""

LEGS = ("femur", "tibia", "foot", "toes")
ARMS = ("clavicle", "humerus", "radius", "wrist", "hand", "fingers", "thumb")

CURVES: Mapping[str, Curve] = {
    "femur.rx": (-14.0, ((-20.7, 0.34), (-3.8, 2.93), (-0.9, -0.98))),
    "femur.ry": (6.0, ((3.0, 0.8), (1.0, 2.0))),
    "femur.rz": (-2.0, ((-4.0, -1.6), (1.0, 0.5))),
    "tibia.rx": (22.1, ((21.0, 1.75), (15.9, -2.53), (4.7, -1.44), (0.6, -2.47))),
    "foot.rx": (0.0, ((4.6, 1.61), (6.1, -1.33), (2.1, 1.22))),
    "foot.rz": (1.0, ((3.0, -1.2), (1.5, 0.4))),
    "toes.rx": (-10.0, ((6.3, -0.7), (6.8, 2.73), (3.1, -1.46))),
    "clavicle.ry": (0.0, ()),
    "clavicle.rz": (0.0, ()),
    "humerus.rx": (-4.0, ((-16.0, 0.2), (1.5, 1.0))),
    "humerus.ry": (5.0, ((4.0, 0.6),)),
    "humerus.rz": (-9.0, ((1.5, 0.9),)),
    "radius.rx": (21.0, ((-8.0, 0.1), (2.0, 2.1))),
    "wrist.ry": (-12.0, ((3.0, 1.1),)),
    "hand.rx": (8.0, ((4.0, -0.5), (1.0, 1.0))),
    "hand.rz": (4.0, ((2.0, 2.0),)),
    "fingers.rx": (7.0, ()),
    "thumb.rx": (12.0, ((3.0, -0.5), (0.8, 1.0))),
    "thumb.rz": (-20.0, ((1.0, 2.0),)),
    "root.rx": (3.0, ((0.4, 1.0), (1.5, 0.6))),
    "root.ry": (0.0, ((-5.0, 0.1), (0.5, 1.0))),
    "root.rz": (0.0, ((3.0, -1.57), (0.6, 0.8))),
    "lowerback.rx": (-2.0, ((0.3, 0.2), (1.2, 3.5))),
    "lowerback.ry": (0.0, ((3.5, 0.2), (0.3, 1.0))),
    "lowerback.rz": (0.0, ((-2.5, -1.5), (0.4, 0.5))),
    "upperback.rx": (0.5, ((0.2, 1.2), (0.6, 3.0))),
    "upperback.ry": (0.0, ((3.5, 0.2), (0.3, 1.0))),
    "upperback.rz": (0.0, ((-1.5, -1.4), (0.3, 0.5))),
    "thorax.rx": (1.0, ((0.2, 2.2), (0.4, 2.4))),
    "thorax.ry": (0.0, ((3.0, 0.3), (0.2, 1.0))),
    "thorax.rz": (0.0, ((1.0, -1.5), (0.2, 0.5))),
    "lowerneck.rx": (12.0, ((0.5, 1.0), (0.8, 0.5))),
    "lowerneck.ry": (0.0, ((-2.0, 0.3), (0.3, 1.0))),
    "lowerneck.rz": (0.0, ((0.8, -1.0), (0.3, 0.5))),
    "upperneck.rx": (-10.0, ((0.5, 2.0), (0.7, 3.1))),
    "upperneck.ry": (0.0, ((-2.0, 0.3), (0.3, 1.0))),
    "upperneck.rz": (0.0, ((0.7, 1.5), (0.3, 0.5))),
    "head.rx": (-3.0, ((0.3, 2.0), (0.5, 3.3))),
    "head.ry": (0.0, ((-1.0, 0.3), (0.2, 1.0))),
    "head.rz": (0.0, ((0.4, 1.2), (0.2, 0.5))),
}


@dataclass(frozen=True)
class Style:
    """How a gait differs from ordinary walking.

    Parameters
    ----------
    cadence : float
        Cycles (two steps) per second.
    legs, arms : float
        Factors of the harmonics' amplitudes.
    flight : float
        Height of the jump between two steps, in the skeleton's unit of length.
    offsets : mapping of str to float
        Degrees added to the offset of a curve.
    """

    cadence: float
    legs: float = 1.0
    arms: float = 1.0
    flight: float = 0.0
    offsets: Mapping[str, float] = field(default_factory=dict)

    def swing(self, curve: str) -> float:
        """Return the factor of a curve's amplitudes, such as that of ``femur.rx``."""
        segment = curve.partition(".")[0]
        return self.legs if segment in LEGS else self.arms if segment in ARMS else 1.0


STYLES: Mapping[str, Style] = {
    "walk": Style(0.95),
    "slow walk": Style(0.75, legs=0.8, arms=0.6),
    "stride": Style(0.85, legs=1.3, arms=1.5, offsets={"tibia.rx": 6.0, "root.rx": 2.0}),
    "run": Style(
        1.4,
        legs=1.45,
        arms=1.6,
        flight=1.2,
        offsets={"tibia.rx": 14.0, "femur.rx": -8.0, "radius.rx": 55.0, "root.rx": 7.0},
    ),
}
