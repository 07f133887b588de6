"""The recordings of the thesis: its frames, resampled, in its channels (§5.2.2, footnotes 5–7).

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017.
"""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.datasets import (
    THESIS_CHANNELS,
    Archive,
    Recording,
    resample,
    restart,
    zero_based_frames,
)

__all__ = ["EVALUATION", "KICKS", "N_FRAMES", "TRAINING", "WALKS", "Window", "read_excerpt"]

N_FRAMES = 90

Window = tuple[int, int]

TRAINING: Mapping[str, Window] = {
    "cmu:02_01": (0, 298),
    "cmu:02_02": (0, 298),
    "cmu:07_02": (0, 298),
    "cmu:08_07": (0, 298),
    "cmu:10_05": (0, 436),
    "cmu:10_06": (130, 566),
}
"""Frames of the recordings that models are trained on, 0-based and half open."""

EVALUATION: Mapping[str, Window] = {
    "cmu:12_01": (0, 358),
    "cmu:16_15": (0, 358),
    "cmu:38_02": (0, 358),
    "cmu:35_01": (0, 358),
    "cmu:39_04": (0, 358),
    "cmu:10_05": (0, 232),
    "cmu:10_03": (130, 362),
    "cmu:10_02": (130, 362),
    "cmu:10_06": (130, 362),
    "cmu:11_01": (130, 362),
}
"""Frames of the recordings that samples are compared with."""

# References in the thesis's notation, subject(motion).
WALKS = {
    "12(1)": "cmu:12_01",
    "16(15)": "cmu:16_15",
    "38(2)": "cmu:38_02",
    "35(1)": "cmu:35_01",
    "39(4)": "cmu:39_04",
}
KICKS = {
    "10(5)": "cmu:10_05",
    "10(3)": "cmu:10_03",
    "10(2)": "cmu:10_02",
    "10(6)": "cmu:10_06",
    "11(1)": "cmu:11_01",
}

_GENERATED: Window = (0, 298)


def read_excerpt(archive: Archive, uri: str, windows: Mapping[str, Window]) -> Recording:
    """Return 90 frames of a recording's window in 39 channels, its times counted from 0.

    Generated gait, which the thesis does not name, is cut like the thesis's training walks.

    Raises
    ------
    RecordingUnavailable
        If the recording is not at hand.
    """
    recording = zero_based_frames(archive.recording(uri), *windows.get(uri, _GENERATED))
    return restart(resample(recording, N_FRAMES).select(THESIS_CHANNELS))
