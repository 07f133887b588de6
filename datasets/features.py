"""Channels and frame rates of each paper's experiments, from the 62 channels of the CMU database.

- Thesis: J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*,
  MSc thesis, Universidad Tecnológica de Pereira, 2017.
- GPDM: Wang, Fleet and Hertzmann, Gaussian process dynamical models for human motion, 2008.
- HLM: Pan and Torresani, Unsupervised hierarchical modeling of locomotion styles, 2009.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.preprocessing import root_differences
from mocapbench.datasets.recording import Recording

__all__ = [
    "THESIS_CHANNELS",
    "gpdm_channels",
    "gpdm_features",
    "hlm_features",
    "smoothness",
    "thesis_candidates",
]

# fmt: off
THESIS_CHANNELS = (
    "root.tx", "root.ty", "root.tz", "root.rx", "root.ry", "root.rz",
    "lowerback.rx", "lowerback.ry", "lowerback.rz",
    "upperback.ry", "upperback.rz",
    "thorax.rx", "thorax.ry", "thorax.rz",
    "lowerneck.rx", "lowerneck.ry",
    "upperneck.rx", "upperneck.ry",
    "head.rx", "head.ry",
    "rhumerus.rx", "rhumerus.ry", "rhumerus.rz",
    "rradius.rx",
    "lhumerus.rx", "lhumerus.ry", "lhumerus.rz",
    "lradius.rx",
    "rfemur.rx", "rfemur.rz",
    "rtibia.rx",
    "rfoot.rx", "rfoot.rz",
    "lfemur.rx", "lfemur.ry", "lfemur.rz",
    "ltibia.rx",
    "lfoot.rx", "lfoot.rz",
)
# fmt: on
"""The 39 channels of every motion task of the thesis.

The thesis states their number and the criterion, not their names. They are the
``thesis_candidates`` without the five of least ``smoothness``, averaged over the 90 resampled
frames of 02_01, 02_02 and 07_02.
"""

_THESIS_REJECTED = ("clavicle", "fingers", "wrist", "hand", "thumb", "toes")
_GPDM_REJECTED = ("fingers", "thumb", "hand", "toes")
_STEP = 4  # from 120 to the papers' 30 frames per second


def smoothness(recording: Recording) -> NDArray[np.float64]:
    """Return log₁₀(var x / var Δx) of each channel (D,), variances with ddof 0.

    The thesis leaves out the five channels with the lowest value, the noisiest. A constant channel
    gives NaN.
    """
    variance = recording.values.var(axis=0)
    roughness = np.diff(recording.values, axis=0).var(axis=0)
    moving = (variance > 0) & (roughness > 0)
    ratio = np.divide(variance, roughness, out=np.full_like(variance, np.nan), where=moving)
    return np.asarray(np.log10(ratio))


def thesis_candidates(recording: Recording) -> Recording:
    """Return the 44 channels from which `THESIS_CHANNELS` were chosen, without extremities."""
    return _without(recording, _THESIS_REJECTED)


def gpdm_features(recording: Recording) -> Recording:
    """Return the 50 channels of GPDM at every 4th frame, from the first.

    They are 44 joint angles (no fingers, thumbs, hands or toes), the root's three rotations, and
    the differences of its translation between the frames kept. Cut out a part of a recording
    before, not after: the last difference is a copy of the one before it.

    Parameters
    ----------
    recording : Recording
        N frames of the 62 channels of the CMU database, at 120 frames per second.

    Returns
    -------
    Recording
        ⌈N / 4⌉ frames of 50 channels, at 30 frames per second.

    Raises
    ------
    ValueError
        If a channel of the root's translation is missing, or fewer than two frames remain.

    References
    ----------
    Wang, Fleet and Hertzmann (2008), Gaussian process dynamical models for human motion.

    Examples
    --------
    >>> from mocapbench.datasets import gpdm_features, open_archive
    >>> walk = open_archive().recording("gait:01_01")
    >>> walk.values.shape, gpdm_features(walk).values.shape
    ((331, 62), (83, 50))
    """
    return gpdm_channels(_every_fourth(recording))


def gpdm_channels(recording: Recording) -> Recording:
    """Return the 50 channels of GPDM of a recording, at the frames that it has.

    Parameters
    ----------
    recording : Recording
        With the 62 channels of the CMU database, such as every 4th frame of one.

    Raises
    ------
    ValueError
        As `gpdm_features`.

    See Also
    --------
    gpdm_features : Says which, and takes every 4th frame.
    """
    return root_differences(_without(recording, _GPDM_REJECTED))


def hlm_features(recording: Recording) -> Recording:
    """Return the 62 channels of HLM at every 4th frame, the root's translation as differences.

    Joint angles are mapped to [−180, 180) degrees, because HLM §4 has them "parameterized so as to
    avoid discontinuities": in the files, the right thumb of 08_01 turns by three times 360° in a
    tenth of a second.

    Parameters
    ----------
    recording : Recording
        N frames of the 62 channels of the CMU database, at 120 frames per second.

    Returns
    -------
    Recording
        ⌈N / 4⌉ frames of 62 channels, at 30 frames per second.

    Raises
    ------
    ValueError
        If a channel of the root's translation is missing, or fewer than two frames remain.

    References
    ----------
    Pan and Torresani (2009), Unsupervised hierarchical modeling of locomotion styles, §4.

    Examples
    --------
    >>> from mocapbench.datasets import hlm_features, open_archive
    >>> hlm_features(open_archive().recording("gait:01_01")).channels[:3]
    ('root.dtx', 'root.dty', 'root.dtz')
    """
    return root_differences(_wrap_joint_angles(_every_fourth(recording)))


def _wrap_joint_angles(recording: Recording) -> Recording:
    """Return the recording with all joint angles but the root's in [−180, 180) degrees."""
    joint = np.array(
        [
            unit == "deg" and not name.startswith("root.")
            for name, unit in zip(recording.channels, recording.units, strict=True)
        ]
    )
    turns = np.where(joint, np.floor((recording.values + 180.0) / 360.0), 0.0)
    return recording.with_values(recording.values - 360.0 * turns)


def _without(recording: Recording, segments: tuple[str, ...]) -> Recording:
    """Return the channels whose segment's name ends in none of ``segments``."""
    return recording.select(
        [name for name in recording.channels if not name.partition(".")[0].endswith(segments)]
    )


def _every_fourth(recording: Recording) -> Recording:
    return recording.frames(np.arange(0, len(recording.times), _STEP))
