"""A procedural walker: joint angles from Fourier curves, the root's path from the feet.

Amplitudes, phases, cadence and posture vary between subjects; style, slow drifts and sensor noise
vary between trials. The root's height follows from the lower foot standing on the floor, and its
path from the supporting foot not sliding.

The curves approximate the normal sagittal curves of gait analysis (Perry & Burnfield, *Gait
Analysis*, 2010). Phase 0 is the strike of the left heel, and a curve is

    x(φ) = offset + Σ_k a_k cos(k φ + p_k).

Curves of limbs (``femur.rx``) are given for the left side; the right side runs half a cycle later,
mirrored.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np
import scipy  # which imports its parts where they are used

from mocapbench.datasets.acclaim.motion import FRAME_RATE, Motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.kinematics import FrameByJointBy3, joint_positions
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["ARMS", "LEGS", "walk"]

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


CADENCES = {"walk": 0.95, "slow walk": 0.75, "stride": 0.85, "run": 1.4}
"""Cycles (two steps) per second of each style."""

SWINGS = {"slow walk": (0.8, 0.6), "stride": (1.3, 1.5), "run": (1.45, 1.6)}
"""Factors of the amplitudes of legs and of arms, where a style differs from ordinary walking."""

FLIGHTS = {"run": 1.2}
"""Height of the jump between two steps, in the skeleton's unit of length."""

OFFSETS = {
    "stride": {"tibia.rx": 6.0, "root.rx": 2.0},
    "run": {"tibia.rx": 14.0, "femur.rx": -8.0, "radius.rx": 55.0, "root.rx": 7.0},
}
"""Degrees that a style adds to the offset of a curve."""

_SOLE = {"tibia": 0.7, "foot": 0.1, "toes": 0.1}
"""Height of a segment's end above the floor when the foot stands on it, in the skeleton's unit."""

_ROOT_PATH = ("root.tx", "root.ty", "root.tz")


def walk(skeleton: Skeleton, style: str, subject: int, trial: int) -> Motion:
    """Return the motion of one subject in one trial, 300 to 360 frames, at `FRAME_RATE`.

    Parameters
    ----------
    skeleton : Skeleton
        With the segments of the CMU database.
    style : str
        One of `CADENCES`.
    subject, trial : int
        Seeds of what varies between subjects and between trials.
    """
    habits, rng = np.random.default_rng([subject]), np.random.default_rng([subject, trial])
    n_frames = int(rng.integers(300, 361))
    cadence = CADENCES[style] * habits.normal(1.0, 0.06)
    rate = 2 * pi * cadence / FRAME_RATE * (1 + 0.03 * _smooth(rng, n_frames, 60))
    phase = rng.uniform(0, 2 * pi) + np.cumsum(rate)
    channels = [f"{name}.{dof}" for name, dofs in skeleton.moving.items() for dof in dofs]
    curves = {
        channel: _angle(channel, phase, style, habits, rng)
        for channel in channels
        if channel not in _ROOT_PATH
    }
    path = _root_path(skeleton, curves, phase, style) + 0.01 * rng.standard_normal((n_frames, 3))
    curves |= dict(zip(_ROOT_PATH, path.T, strict=True))
    values = np.column_stack([curves[channel] for channel in channels])
    return Motion(skeleton, tuple(skeleton.moving), values)


def _angle(
    channel: str, phase: Frames, style: str, habits: np.random.Generator, rng: np.random.Generator
) -> Frames:
    """Return the curve (N,) of one channel, in degrees; one without harmonics is constant."""
    name, lag, sign = _side(channel)
    offset, harmonics = CURVES[name]
    posture = offset + OFFSETS.get(style, {}).get(name, 0.0) + habits.normal(0.0, 1.5)
    swing = _swing(name, style) * habits.normal(1.0, 0.08)
    lag += habits.normal(0.0, 0.08)
    if not harmonics:
        return np.full(len(phase), sign * posture)
    drift = 1 + 0.04 * _smooth(rng, len(phase), 60)
    noise = 0.5 * _smooth(rng, len(phase), 12) + 0.15 * rng.standard_normal(len(phase))
    waves = [a * np.cos(k * (phase + lag) + p) for k, (a, p) in enumerate(harmonics, 1)]
    return np.asarray(sign * (posture + swing * drift * np.sum(waves, axis=0)) + noise)


def _swing(curve: str, style: str) -> float:
    """Return the factor of a curve's amplitudes, such as that of ``femur.rx``."""
    legs, arms = SWINGS.get(style, (1.0, 1.0))
    segment = curve.partition(".")[0]
    return legs if segment in LEGS else arms if segment in ARMS else 1.0


def _side(channel: str) -> tuple[str, float, float]:
    """Return the curve's name, its lag behind the left side in radians, and its sign."""
    if channel in CURVES:
        return channel, 0.0, 1.0
    if channel[0] == "l":
        return channel[1:], 0.0, 1.0
    return channel[1:], pi, 1.0 if channel.endswith("rx") else -1.0


def _root_path(
    skeleton: Skeleton, curves: Mapping[str, Frames], phase: Frames, style: str
) -> FrameByChannel:
    """Return the root's translation (N, 3) in the skeleton's unit of length."""
    soles = _soles(skeleton, curves)
    # The supporting foot does not slide: the root advances by as much as that foot recedes from it.
    balls = scipy.ndimage.gaussian_filter1d(soles[:, 1::3, 2], 3, axis=0)
    pace = -np.gradient(balls, axis=0).min(axis=1)
    flight = FLIGHTS.get(style, 0.0) * np.clip(np.cos(2 * phase + 0.6), 0.0, None)
    height = flight - scipy.ndimage.gaussian_filter1d(soles[..., 1].min(axis=1), 3)
    return np.column_stack(
        [0.35 * np.sin(phase), height, np.cumsum(scipy.ndimage.gaussian_filter1d(pace, 8))]
    )


def _soles(skeleton: Skeleton, curves: Mapping[str, Frames]) -> FrameByJointBy3:
    """Return the positions of heel, ball and toe of both soles, with the root at the origin."""
    times = np.arange(len(curves["root.rx"])) / FRAME_RATE
    angles = Recording(
        "gait", times, np.column_stack(list(curves.values())), tuple(curves), ("deg",) * len(curves)
    )
    names = [segment.name for segment in skeleton.segments]
    ends = [names.index(side + name) for side in "lr" for name in _SOLE]
    soles = joint_positions(skeleton, angles)[:, ends] / skeleton.centimetres_per_unit
    soles[..., 1] -= [*_SOLE.values()] * 2
    return soles


def _smooth(rng: np.random.Generator, n_frames: int, width: float) -> Frames:
    """Return noise of about unit variance, smoothed by a Gaussian kernel of ``width`` frames."""
    gain = np.sqrt(2 * width * np.sqrt(pi))  # undoes the loss of variance by smoothing
    return np.asarray(gain * scipy.ndimage.gaussian_filter1d(rng.standard_normal(n_frames), width))
