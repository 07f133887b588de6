"""Recordings and where they come from."""

from mocapbench.datasets.acclaim_errors import AcclaimError, TruncatedFrameWarning
from mocapbench.datasets.acclaim_motion import FRAME_RATE, Motion, format_motion
from mocapbench.datasets.acclaim_motion_reader import parse_motion, read_motion
from mocapbench.datasets.acclaim_skeleton import Segment, Skeleton, format_skeleton
from mocapbench.datasets.acclaim_skeleton_reader import parse_skeleton, read_skeleton
from mocapbench.datasets.archive import Archive, open_archive
from mocapbench.datasets.cmu import CMU_ACKNOWLEDGEMENT, CMU_URL, CMULibrary, registered_digests
from mocapbench.datasets.digests import DigestMismatch, UnregisteredDigestWarning
from mocapbench.datasets.download import FetchError, ServerUnreachable
from mocapbench.datasets.features import THESIS_CHANNELS, gpdm_features, hlm_features
from mocapbench.datasets.gait import GAIT_VERSION, GaitLibrary, gait_style
from mocapbench.datasets.kinematics import FrameByJointBy3, joint_positions
from mocapbench.datasets.library import Library, RecordingStatus, RecordingUnavailable
from mocapbench.datasets.preprocessing import (
    clip,
    excerpt,
    integrate_root,
    resample,
    restart,
    root_differences,
)
from mocapbench.datasets.process import Layer, ToyProcess
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = [
    "CMU_ACKNOWLEDGEMENT",
    "CMU_URL",
    "FRAME_RATE",
    "GAIT_VERSION",
    "THESIS_CHANNELS",
    "AcclaimError",
    "Archive",
    "CMULibrary",
    "DigestMismatch",
    "FetchError",
    "FrameByChannel",
    "FrameByJointBy3",
    "Frames",
    "GaitLibrary",
    "Layer",
    "Library",
    "Mask",
    "Motion",
    "Recording",
    "RecordingStatus",
    "RecordingUnavailable",
    "Segment",
    "ServerUnreachable",
    "Skeleton",
    "ToyProcess",
    "TruncatedFrameWarning",
    "UnregisteredDigestWarning",
    "clip",
    "excerpt",
    "format_motion",
    "format_skeleton",
    "gait_style",
    "gpdm_features",
    "hlm_features",
    "integrate_root",
    "joint_positions",
    "open_archive",
    "parse_motion",
    "parse_skeleton",
    "read_motion",
    "read_skeleton",
    "registered_digests",
    "resample",
    "restart",
    "root_differences",
]
