"""Files of every format, made of recordings: what a user might have, gaps included."""

from dataclasses import replace

import numpy as np
import pandas as pd

from mocapbench.datasets import (
    GaitLibrary,
    Recording,
    format_motion,
    format_skeleton,
    joint_positions,
)

KEY = "01_05"
GAIT = GaitLibrary()


def walk(n_frames=60):
    """Return joint angles and the root's path, without gaps."""
    return GAIT.recording(KEY).frames(np.arange(n_frames))


def markers(n_frames=60, n_markers=5):
    """Return the positions of joints in millimetres, without gaps."""
    skeleton = GAIT.skeleton(KEY)
    positions = 10.0 * joint_positions(skeleton, walk(n_frames))[:, :n_markers]
    names = [segment.name for segment in skeleton.segments[:n_markers]]
    channels = [f"{name}.{axis}" for name in names for axis in "xyz"]
    values = positions.reshape(n_frames, -1)
    return Recording("markers", walk(n_frames).times, values, channels, ["mm"] * len(channels))


def with_gap(recording):
    """Return the recording with frames 20 to 30 of its first three channels hidden."""
    hidden = np.zeros(recording.values.shape, dtype=bool)
    hidden[20:30, :3] = True
    return recording.hide(hidden)


def _table(recording):
    headers = [
        f"{name} [{unit}]" if unit else name
        for name, unit in zip(recording.channels, recording.units, strict=True)
    ]
    return pd.DataFrame(recording.values, columns=headers).assign(time=recording.times, side="left")


def write_csv(path, recording):
    _table(recording).to_csv(path, index=False)


def write_parquet(path, recording):
    _table(recording).to_parquet(path)


def write_acclaim(path, recording):
    """Write a walk and its skeleton beside it."""
    motion = GAIT.motion(KEY)
    path.with_suffix(".asf").write_text(format_skeleton(motion.skeleton))
    path.write_text(format_motion(replace(motion, values=recording.values)))


def write_trc(path, recording):
    n_frames, n_channels = recording.values.shape
    names = [channel[:-2] for channel in recording.channels[::3]]
    facts = {
        "DataRate": "120.00",
        "CameraRate": "120.00",
        "NumFrames": str(n_frames),
        "NumMarkers": str(n_channels // 3),
        "Units": recording.units[0],
        "OrigDataRate": "120.00",
        "OrigDataStartFrame": "1",
        "OrigNumFrames": str(n_frames),
    }
    axes = [f"{axis}{k + 1}" for k in range(n_channels // 3) for axis in "XYZ"]
    rows = (
        [str(k + 1), f"{time:.6f}", *("" if np.isnan(v) else f"{v:.5f}" for v in row)]
        for k, (time, row) in enumerate(zip(recording.times, recording.values, strict=True))
    )
    lines = [
        ["PathFileType", "4", "(X/Y/Z)", path.name],
        [*facts],
        [*facts.values()],
        ["Frame#", "Time", *(cell for name in names for cell in (name, "", ""))],
        ["", "", *axes],
        [],
        *rows,
    ]
    path.write_text("\r\n".join("\t".join(line) for line in lines) + "\r\n", newline="")


def write_bvh(path, recording):
    """Write segments as a chain of joints, each with the channels that it has."""
    kinds = {"tx": "Xposition", "ty": "Yposition", "tz": "Zposition"}
    kinds |= {"rx": "Xrotation", "ry": "Yrotation", "rz": "Zrotation"}
    joints = {}
    for channel in recording.channels:
        name, _, kind = channel.partition(".")
        joints.setdefault(name, []).append(kinds[kind])
    lines = ["HIERARCHY"]
    for depth, (name, channels) in enumerate(joints.items()):
        lines += [f"{'JOINT' if depth else 'ROOT'} {name}", "{", "  OFFSET 0.0 1.0 0.0"]
        lines += [f"  CHANNELS {len(channels)} {' '.join(channels)}"]
    lines += ["End Site", "{", "  OFFSET 0.0 1.0 0.0", "}", *"}" * len(joints), "MOTION"]
    lines += [f"Frames: {len(recording.times)}", "Frame Time: 0.0083333"]
    lines += [" ".join(f"{value:.6f}" for value in row) for row in recording.values]
    path.write_text("\n".join(lines) + "\n")


def poses(n_frames=60):
    """Return rotation vectors of 22 joints and the path of the root, as AMASS has them."""
    angles = np.radians(walk(n_frames).values[:, 6:])
    values = np.hstack([np.resize(angles.T, (66, n_frames)).T, walk(n_frames).values[:, :3] / 100])
    names = [f"joint{k}.r{axis}" for k in range(22) for axis in "xyz"]
    channels = [*names, "trans.x", "trans.y", "trans.z"]
    return Recording("poses", walk(n_frames).times, values, channels, ["rad"] * 66 + ["m"] * 3)


def write_npz(path, recording):
    """Write poses and translations, and what else AMASS has: shape, sex, and the poses in parts."""
    values = recording.values
    np.savez_compressed(
        path,
        trans=values[:, 66:],
        gender=np.array("neutral"),
        mocap_framerate=np.array(120.0),
        betas=np.zeros(16),
        poses=values[:, :66],
        root_orient=values[:, :3],
        pose_body=values[:, 3:66],
    )


def write_c3d(path, recording):
    """Write markers by ezc3d; points with hidden coordinates have the residual −1."""
    import ezc3d  # noqa: PLC0415

    n_frames = len(recording.times)
    points = recording.values.reshape(n_frames, -1, 3).transpose(2, 1, 0)
    hidden = np.isnan(points).any(axis=0)
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [120.0]
    file["parameters"]["POINT"]["UNITS"]["value"] = [recording.units[0]]
    labels = [channel[:-2] for channel in recording.channels[::3]]
    file["parameters"]["POINT"]["LABELS"]["value"] = labels
    file["data"]["points"] = np.concatenate(
        [np.nan_to_num(points), np.ones((1, *points.shape[1:]))]
    )
    file["data"]["meta_points"]["residuals"] = np.where(hidden, -1.0, 0.5)[None]
    file["parameters"]["ANALOG"]["RATE"]["value"] = [240.0]
    file["parameters"]["ANALOG"]["LABELS"]["value"] = ["EMG"]
    file["data"]["analogs"] = np.sin(np.arange(2.0 * n_frames))[None, None]
    file.write(str(path))


def sample(name, folder, n_frames=60):
    """Return a file of a format, with a gap where the format can state one."""
    made = {
        "acclaim": ("walk.amc", write_acclaim, walk(n_frames)),
        "bvh": ("walk.bvh", write_bvh, with_gap(walk(n_frames))),
        "c3d": ("markers.c3d", write_c3d, with_gap(markers(n_frames))),
        "csv": ("walk.csv", write_csv, with_gap(walk(n_frames))),
        "npz": ("walk.npz", write_npz, with_gap(poses(n_frames))),
        "parquet": ("walk.parquet", write_parquet, with_gap(walk(n_frames))),
        "trc": ("markers.trc", write_trc, with_gap(markers(n_frames))),
    }
    file, write, recording = made[name]
    write(folder / file, recording)
    return folder / file
