"""The recordings of HLM's experiments with their styles, and generated ones like them.

HLM: W. Pan and L. Torresani, *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML 2009.
"""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.datasets import Archive, Recording, gait_style, hlm_features

__all__ = ["CMU", "SYNTHETIC", "Styles", "read_features", "select_subject"]


Styles = Mapping[str, str]
"""The style of each recording of cyclic motion, by its address."""


def read_features(styles: Styles, archive: Archive) -> dict[str, Recording]:
    """Return HLM's 62 channels at 30 Hz of each recording, by its address."""
    return {uri: hlm_features(archive.recording(uri)) for uri in styles}


def select_subject(styles: Styles, subject: str) -> tuple[str, ...]:
    """Return the addresses of the recordings of a subject such as ``cmu:07``."""
    return tuple(uri for uri in styles if uri.startswith(f"{subject}_"))


# Subject and trials of each style, after the database's index of motions.
_CMU_TRIALS = (
    ("07", "walk", (1, 2, 3, 6, 7, 8, 9, 10, 11)),
    ("07", "slow walk", (4, 5)),
    ("08", "walk", (1, 2, 3, 6, 8, 9, 10)),
    ("08", "slow walk", (4,)),
    ("08", "stride", (5, 7, 11)),
    ("09", "run", tuple(range(1, 10))),
    ("35", "walk", tuple(range(1, 9))),
)
# Eleven walks and slow walks of one subject, as in the database, and every style of two others.
_SYNTHETIC_TRIALS = (
    ("01", (1, 2, 3, 6, 7, 8, 11, 12, 13, 16, 17)),
    ("02", (1, 2, 3, 4, 5)),
    ("03", (1, 2, 3, 4, 5)),
)

_CMU_STYLES = {
    f"cmu:{subject}_{trial:02}": style for subject, style, trials in _CMU_TRIALS for trial in trials
}
SYNTHETIC: Styles = {
    f"gait:{key}": gait_style(key)
    for subject, trials in _SYNTHETIC_TRIALS
    for key in (f"{subject}_{trial:02}" for trial in trials)
}
"""21 generated recordings of three subjects in the same four styles."""

CMU: Styles = dict(sorted(_CMU_STYLES.items()))
"""HLM §4.1: 39 recordings of subjects 07, 08, 09 and 35 in four styles."""
