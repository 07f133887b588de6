"""A file of the structure of lafan1.zip: takes of five subjects, as BVH files of 22 joints."""

from zipfile import ZipFile

import numpy as np

LIMBS = {
    "Hips": ["LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToe"],
    "Hips ": ["RightUpLeg", "RightLeg", "RightFoot", "RightToe"],
    "Hips  ": ["Spine", "Spine1", "Spine2", "Neck", "Head"],
    "Spine2": ["LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand"],
    "Spine2 ": ["RightShoulder", "RightArm", "RightForeArm", "RightHand"],
}
PARENTS = {"Hips": ""}
for _root, _limb in LIMBS.items():
    PARENTS |= dict(zip(_limb, [_root.strip(), *_limb], strict=False))
JOINTS = []
"""The 22 joints in the order of the file: every parent is followed by all that it carries."""


def _list_joints(name):
    JOINTS.append(name)
    for child, parent in PARENTS.items():
        if parent == name:
            _list_joints(child)


_list_joints("Hips")
OFFSETS = {name: (1.0 + k, 10.0 + k, -0.5 * k) for k, name in enumerate(JOINTS)}
ROTATIONS = "Zrotation Yrotation Xrotation"


def write_joint(name, indent=""):
    """Return the lines of a joint and of all that it carries."""
    first = "Xposition Yposition Zposition " if name == "Hips" else ""
    children = [child for child, parent in PARENTS.items() if parent == name]
    x, y, z = OFFSETS[name]
    inner = [
        f"OFFSET {x:.6f} {y:.6f} {z:.6f}",
        f"CHANNELS {6 if first else 3} {first}{ROTATIONS}",
        *(line for child in children for line in write_joint(child)),
        *([] if children else ["End Site", "{", "\tOFFSET 0.0 1.0 0.0", "}"]),
    ]
    head = "ROOT" if name == "Hips" else "JOINT"
    return [f"{indent}{head} {name}", "{", *(f"\t{line}" for line in inner), "}"]


def write_take(path, angles):
    """Return the text of a take of N frames: the root's path (N, 3), and angles (N, 22, 3)."""
    rows = np.hstack([path, angles.reshape(len(path), -1)])
    lines = ["HIERARCHY", *write_joint("Hips"), "MOTION", f"Frames: {len(rows)}"]
    lines += ["Frame Time: 0.033333", *(" ".join(f"{v:.6f}" for v in row) for row in rows)]
    return "\n".join(lines) + "\n"


def write_zip(file, make_take, lengths=(150, 120)):
    """Write takes of five subjects; ``make_take(subject, take, n_frames)`` has path and angles."""
    with ZipFile(file, "w") as archive:
        for subject in range(1, 6):
            for take, n_frames in enumerate(lengths, start=1):
                text = write_take(*make_take(subject, take, n_frames))
                archive.writestr(f"walk{take}_subject{subject}.bvh", text)
    return file
