from .acclaim.errors import AcclaimError, TruncatedFrameWarning
from .acclaim.motion import FRAME_RATE, Motion, format_motion
from .acclaim.motion_reader import parse_motion, read_motion
from .acclaim.skeleton import Segment, Skeleton, format_skeleton
from .acclaim.skeleton_reader import parse_skeleton, read_skeleton
from .archive import Archive, RecordingStatus, open_archive
from .cmu import CMU_ACKNOWLEDGEMENT, CMU_URL, CMULibrary, registered_digests
from .digests import DigestMismatch, UnregisteredDigestWarning
from .errors import FetchError, RecordingUnavailable, ServerUnreachable, SkeletonUnavailable
from .features import THESIS_CHANNELS, gpdm_channels, gpdm_features, hlm_features
from .formats.angle_wrapping import unwrap_angles
from .formats.base import Format
from .formats.errors import FormatError, FormatWarning, MissingExtraError, TextColumnsWarning
from .formats.joints.acclaim_motion import AcclaimFormat
from .formats.joints.bvh import BVHFormat
from .formats.joints.pose_arrays import NPZFormat
from .formats.markers.c3d import C3DFormat
from .formats.markers.trc import TRCFormat
from .formats.sets import check_alike, frame_rate
from .formats.tables.comma_separated import CSVFormat
from .formats.tables.parquet import ParquetFormat
from .generated.gait import GAIT_VERSION, GaitLibrary, gait_style
from .keys import subject_of
from .kinematics import (
    FrameByJointBy3,
    joint_positions,
    joint_trajectories,
    position_channels,
)
from .lafan1.takes import LaFAN1Library
from .library import Library, named_folders
from .people import People, generated_people, read_people
from .preprocessing import (
    integrate_root,
    one_based_frames,
    resample,
    restart,
    root_differences,
    zero_based_frames,
)
from .process import Layer, ToyProcess
from .recording import FrameByChannel, Frames, Mask, Recording
from .rotations.body import (
    PREDICTED,
    coincident_joints,
    complete_joints,
    place_rotated_joints,
    rotation_skeleton,
)
from .rotations.library import RotationLibrary, original_recordings
from .rotations.recipe import rotations_of
from .taylor import taylor_deviations, taylor_features, taylor_scales

__all__ = [
    "CMU_ACKNOWLEDGEMENT",
    "CMU_URL",
    "FRAME_RATE",
    "GAIT_VERSION",
    "PREDICTED",
    "THESIS_CHANNELS",
    "AcclaimError",
    "AcclaimFormat",
    "Archive",
    "BVHFormat",
    "C3DFormat",
    "CMULibrary",
    "CSVFormat",
    "DigestMismatch",
    "FetchError",
    "Format",
    "FormatError",
    "FormatWarning",
    "FrameByChannel",
    "FrameByJointBy3",
    "Frames",
    "GaitLibrary",
    "LaFAN1Library",
    "Layer",
    "Library",
    "Mask",
    "MissingExtraError",
    "Motion",
    "NPZFormat",
    "ParquetFormat",
    "People",
    "Recording",
    "RecordingStatus",
    "RecordingUnavailable",
    "RotationLibrary",
    "Segment",
    "ServerUnreachable",
    "Skeleton",
    "SkeletonUnavailable",
    "TRCFormat",
    "TextColumnsWarning",
    "ToyProcess",
    "TruncatedFrameWarning",
    "UnregisteredDigestWarning",
    "check_alike",
    "coincident_joints",
    "complete_joints",
    "format_motion",
    "format_skeleton",
    "frame_rate",
    "gait_style",
    "generated_people",
    "gpdm_channels",
    "gpdm_features",
    "hlm_features",
    "integrate_root",
    "joint_positions",
    "joint_trajectories",
    "named_folders",
    "one_based_frames",
    "open_archive",
    "original_recordings",
    "parse_motion",
    "parse_skeleton",
    "place_rotated_joints",
    "position_channels",
    "read_motion",
    "read_people",
    "read_skeleton",
    "registered_digests",
    "resample",
    "restart",
    "root_differences",
    "rotation_skeleton",
    "rotations_of",
    "subject_of",
    "taylor_deviations",
    "taylor_features",
    "taylor_scales",
    "unwrap_angles",
    "zero_based_frames",
]
