"""Tables as programs export them, made by a few lines each, with what is to be read from them.

Each table has five markers, or two bodies, for forty frames at 100 a second, of which the third
marker is missing in frames 10 to 14.
"""

from dataclasses import dataclass

import numpy as np

N, RATE = 40, 100.0
MARKERS = ["LASI", "RASI", "LKNE", "RKNE", "LANK"]
GAP = slice(10, 15)
TIMES = np.arange(N) / RATE


@dataclass(frozen=True)
class Table:
    """A table, and what it says."""

    name: str
    text: str
    channels: tuple
    units: tuple
    values: np.ndarray
    rate: float | None = RATE
    """Which the table states; None if it does not."""


def positions(n_frames=N, n_axes=3):
    """Return smooth paths of the markers, (N, 5 · axes), NaN in the gap."""
    phase = np.arange(5 * n_axes)
    path = 500.0 + 10.0 * phase + 90.0 * np.sin(0.1 * np.arange(n_frames)[:, None] + phase)
    path = np.round(path, 3)
    path[GAP, 2 * n_axes : 3 * n_axes] = np.nan
    return path


def cells(values, missing="", digits=3):
    return [missing if np.isnan(value) else f"{value:.{digits}f}" for value in values]


def join(rows, separator=",", end="\r\n"):
    return "".join(separator.join(map(str, row)) + end for row in rows)


def xyz(prefix="", names=MARKERS):
    return tuple(f"{prefix}{name}.{axis}" for name in names for axis in "xyz")


def motive(titles=True, unit="Meters"):
    """OptiTrack Motive 1.23, or 1.24 with titles of rows and a column of time codes."""
    values = positions()
    facts = ["Format Version", "1.24" if titles else "1.23", "Take Name", "Take, 1"]
    facts[3] = '"Take, 1"'
    facts += ["Capture Frame Rate", "200.000000", "Export Frame Rate", "100.000000"]
    facts += ["Total Exported Frames", N, "Rotation Type", "Quaternion", "Length Units", unit]
    names = [f"Ann:{name}" for name in MARKERS for _ in "xyz"]
    lead = [["", "Type", ""], ["", "Name", ""], ["", "ID", ""], ["", "Parent", ""], ["", "", ""]]
    lead = lead if titles else [["", ""]] * 4
    kinds = [["Marker"] * 15, names, ["1A2B"] * 15, *([[""] * 15] if titles else [])]
    kinds += [["Position"] * 15]
    rows = [
        facts,
        [],
        *(one + two for one, two in zip(lead, kinds, strict=True)),
        ["Frame", "Time (Seconds)", *(["TimeCode"] if titles else []), *"XYZ" * 5],
    ]
    code = [["15:26:46:12.02"] if titles else []] * N
    rows += [[k, f"{TIMES[k]:.6f}", *code[k], *cells(values[k])] for k in range(N)]
    known = {"Meters": "m", "Millimeters": "mm", "Centimeters": "cm"}[unit]
    return Table("take.csv", join(rows), xyz("Ann:"), (known,) * 15, values)


def motive_bodies():
    """Rigid bodies of Motive with quaternions, errors, their markers and strays of other names."""
    rng = np.random.default_rng(0)
    values = np.round(rng.normal(size=(N, 7 + 3 + 3 + 3)).cumsum(axis=0), 6)
    values[GAP] = np.nan
    types = ["Rigid Body"] * 8 + ["Rigid Body Marker"] * 3 + ["Marker"] * 7
    names = ["Box"] * 8 + ["Box:Marker1"] * 3 + ["Box:Marker1"] * 3 + ["Unlabeled 1200"] * 4
    kinds = ["Rotation"] * 4 + ["Position"] * 3 + ["Error Per Marker"] + ["Position"] * 9
    kinds += ["Marker Quality"]
    axes = ["X", "Y", "Z", "W", "X", "Y", "Z", "", *"XYZ" * 3, ""]
    rows = [
        [
            "Format Version",
            "1.22",
            "Export Frame Rate",
            "100.000000",
            "Length Units",
            "Millimeters",
        ],
        [],
        *([["", "", *row] for row in (types, names, ["7"] * 18, kinds)]),
        ["Frame", "Time (Seconds)", *axes],
    ]
    for k in range(N):
        row = cells(values[k], digits=6)
        rows.append([k, f"{TIMES[k]:.6f}", *row[:7], "0.001", *row[7:], "0.9"])
    channels = [f"Box.{axis}" for axis in ("qx", "qy", "qz", "qw", "x", "y", "z")]
    for name in ("Box:Marker1", "Box:Marker1-2", "Unlabeled 1200"):
        channels += [f"{name}.{axis}" for axis in "xyz"]
    return Table("bodies.csv", join(rows), tuple(channels), ("",) * 4 + ("mm",) * 12, values)


def nexus(zeros=False, others=False):
    """Vicon Nexus, alone or between blocks of other things; nothing or zeros where it lacks."""
    values = positions()
    named = [cell for name in MARKERS for cell in (f"Ann:{name}", "", "")]
    block = [
        ["Trajectories"],
        [100],
        ["", "", *named],
        ["Frame", "Sub Frame", *"XYZ" * 5],
        ["", "", *["mm"] * 15],
        *([k + 1, 0, *cells(values[k], "0" if zeros else "")] for k in range(N)),
    ]
    outputs = [
        ["Model Outputs"],
        [100],
        ["", "", "Ann:LHipAngles", "", ""],
        ["Frame", "Sub Frame", *"XYZ"],
        ["", "", *["deg"] * 3],
        *([k + 1, 0, 1.5, 2.5, 3.5] for k in range(N)),
        [],
    ]
    devices = [
        ["Devices"],
        [1000],
        ["", "", "Force plate"],
        ["Frame", "Sub Frame", "Fx"],
        ["", "", "N"],
        *([k // 10 + 1, k % 10, 0.1] for k in range(10 * N)),
        [],
    ]
    rows = [*devices, *outputs, *block, [], *outputs[:-1]] if others else block
    return Table("trial.csv", join(rows), xyz("Ann:"), ("mm",) * 15, values)


def nexus_joints():
    """Joints of Vicon: angles and translations, named by their own axes."""
    values = np.round(np.random.default_rng(1).normal(size=(N, 6)).cumsum(axis=0), 4)
    values[GAP, 3:] = np.nan
    rows = [
        ["Joints"],
        [100],
        ["", "", "Ann:root", "", "", "", "", ""],
        ["Frame", "Sub Frame", "RX", "RY", "RZ", "TX", "TY", "TZ"],
        ["", "", "deg", "deg", "deg", "mm", "mm", "mm"],
        *([k + 1, 0, *cells(values[k], digits=4)] for k in range(N)),
    ]
    channels = tuple(f"Ann:root.{axis}" for axis in ("rx", "ry", "rz", "tx", "ty", "tz"))
    return Table("joints.csv", join(rows), channels, ("deg",) * 3 + ("mm",) * 3, values)


def qualisys(columns=False, missing="0.000"):
    """Positions of Qualisys, without or with a line that names the columns, frame and time."""
    values = positions()
    facts = [["NO_OF_FRAMES", N], ["NO_OF_CAMERAS", 10], ["NO_OF_MARKERS", 5], ["FREQUENCY", 100]]
    facts += [["NO_OF_ANALOG", 0], ["ANALOG_FREQUENCY", 0], ["DESCRIPTION", "--"]]
    facts += [["TIME_STAMP", "2026-01-19, 10:19:43", "94247.45402301"], ["DATA_INCLUDED", "3D"]]
    facts += [["EVENT", "Start", 5, 0.05], ["MARKER_NAMES", *MARKERS]]
    facts += [["TRAJECTORY_TYPES", *["Measured"] * 5]] if columns else []
    named = [f"{name} {axis}" for name in MARKERS for axis in "XYZ"]
    facts += [["Frame", "Time", *named]] if columns else []
    lead = [[k + 1, f"{TIMES[k]:.5f}"] if columns else [] for k in range(N)]
    rows = [*facts, *(lead[k] + cells(values[k], missing) for k in range(N))]
    return Table("walk.tsv", join(rows, "\t"), xyz(), ("mm",) * 15, values)


def qualisys_bodies():
    """Rigid bodies of Qualisys: positions, angles, and what follows from them."""
    values = np.round(np.random.default_rng(2).normal(size=(N, 12)).cumsum(axis=0), 5)
    values[GAP, 6:] = np.nan
    facts = [["NO_OF_FRAMES", N], ["NO_OF_CAMERAS", 4], ["NO_OF_BODIES", 2], ["FREQUENCY", 100]]
    facts += [["DATA_INCLUDED", "6D"], ["BODY_NAMES", "Hip", "Left Foot"]]
    axes = ["X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{k}]" for k in range(9))]
    head = ["Frame", "Time"]
    for body in ("Hip", "Left Foot"):
        head += [f"{body} X", *axes[1:], ""]
    rows = [*facts, head]
    for k in range(N):
        one, two = (cells(values[k, half], "0.00000", 5) for half in (slice(6), slice(6, 12)))
        rest = ["3.1", *["0.50000"] * 9, ""]
        rows.append([k + 1, f"{TIMES[k]:.5f}", *one, *rest, *two, *rest])
    channels = [
        f"{body}.{axis}"
        for body in ("Hip", "Left Foot")
        for axis in ("x", "y", "z", "roll", "pitch", "yaw")
    ]
    units = (("mm",) * 3 + ("deg",) * 3) * 2
    return Table("bodies.tsv", join(rows, "\t"), tuple(channels), units, values)


def qualisys_skeleton():
    """A skeleton of Qualisys: a column with nothing but the name of each segment."""
    values = np.round(np.random.default_rng(6).normal(size=(N, 14)).cumsum(axis=0), 5)
    values[GAP, 7:] = np.nan
    head = [["NO_OF_FRAMES", N], ["NO_OF_CAMERAS", 12], ["FREQUENCY", 100], ["REFERENCE", "GLOBAL"]]
    axes = ["X", "Y", "Z", "QX", "QY", "QZ", "QW"]
    head += [["SOLVER", "Full Body"], ["Frame", "Time", "Hips", *axes, "Spine", *axes]]
    rows = [cells(values[k], digits=5) for k in range(N)]
    rows = [[k + 1, f"{TIMES[k]:.5f}", "", *row[:7], "", *row[7:]] for k, row in enumerate(rows)]
    names = [f"{name}.{axis.lower()}" for name in ("Hips", "Spine") for axis in axes]
    units = ((*("mm",) * 3, *("",) * 4)) * 2
    return Table("walk_s.tsv", join([*head, *rows], "\t"), tuple(names), units, values)


def deeplabcut(individuals=False):
    """DeepLabCut, of one animal or of several, with likelihoods."""
    values = positions(n_axes=2)
    named = [name for name in MARKERS for _ in range(3)]
    rows = [["scorer", *["DLC_resnet50"] * 15]]
    rows += [["individuals", *["mouse1"] * 15]] if individuals else []
    rows += [["bodyparts", *named], ["coords", *["x", "y", "likelihood"] * 5]]
    for k in range(N):
        row = cells(values[k])
        likely = ["0.125" if (k, m) in {(20, 0), (21, 0)} else "0.9" for m in range(5)]
        rows.append([k, *(cell for m in range(5) for cell in (*row[2 * m : 2 * m + 2], likely[m]))])
    prefix = "mouse1." if individuals else ""
    channels = tuple(f"{prefix}{name}.{axis}" for name in MARKERS for axis in "xy")
    return Table("video.csv", join(rows, end="\n"), channels, ("px",) * 10, values, rate=None)


def opensim(separator="\t", degrees="yes"):
    """Coordinates of OpenSim, with tabs, commas or blanks between columns."""
    values = np.round(np.random.default_rng(3).normal(size=(N, 4)).cumsum(axis=0), 8)
    names = ["pelvis_tilt", "pelvis_tx", "hip_flexion_r", "knee_angle_r"]
    values[GAP, 3] = np.nan
    head = ["Coordinates", "version=1", f"nRows={N}", "nColumns=5", f"inDegrees={degrees}", ""]
    head += ["Units are S.I. units (second, meters, Newtons, ...)", "", "endheader"]
    rows = [[line] for line in head] + [["time", *names]]
    numbers = [[f"{cell:>16}" for cell in cells(row, "nan", 8)] for row in values]
    rows += [[f"{TIMES[k]:.8f}", *numbers[k]] for k in range(N)]
    angle = "deg" if degrees == "yes" else "rad"
    units = (angle, "m", angle, angle)
    return Table("ik.mot", join(rows, separator, "\n"), tuple(names), units, values)


def quaternions():
    """Orientations of OpenSim: four numbers with commas between them in each column."""
    values = np.round(np.random.default_rng(4).normal(size=(N, 8)), 12)
    values[GAP, 4:] = np.nan
    rows = [["DataRate=100.000000"], ["DataType=Quaternion"], ["version=3"], ["endheader"]]
    rows += [["time", "pelvis_imu", "tibia_r_imu"]]
    for k in range(N):
        row = cells(values[k], "nan", 12)
        rows.append([f"{TIMES[k]:g}", ",".join(row[:4]), ",".join(row[4:])])
    channels = [
        f"{imu}_imu.{part}" for imu in ("pelvis", "tibia_r") for part in ("qw", "qx", "qy", "qz")
    ]
    return Table("imus.sto", join(rows, "\t", "\n"), tuple(channels), ("",) * 8, values)


def storage():
    """Forces of OpenSim and states, of which names or nothing tell the unit."""
    names = [
        "ground_force_vx",
        "/jointset/hip_r/hip_flexion_r/value",
        "/jointset/p/pelvis_tx/value",
    ]
    names += ["/jointset/hip_r/hip_flexion_r/speed"]
    values = np.round(np.random.default_rng(5).normal(size=(N, 4)).cumsum(axis=0), 6)
    values[GAP, 0] = np.nan
    head = ["states", "inDegrees=no", f"nRows={N}", "nColumns=5", "version=3", "endheader"]
    rows = [[line] for line in head] + [["time", *names]]
    rows += [[f"{TIMES[k]:.3f}", *cells(values[k], "NaN", 6)] for k in range(N)]
    units = ("", "rad", "m", "")
    return Table("states.sto", join(rows, "\t", "\n"), tuple(names), units, values)


def two_lines():
    """Names above axes, as tables of pandas have them."""
    values = positions()
    rows = [["", *(name for name in MARKERS for _ in "xyz")], ["time", *"xyz" * 5]]
    rows += [[f"{TIMES[k]:.2f}", *cells(values[k])] for k in range(N)]
    return Table("frames.csv", join(rows, end="\n"), xyz(), ("",) * 15, values)


def long_rows(numbered=False, likely=True):
    """A row for each marker of each frame, as freemocap and scripts around MediaPipe write it."""
    values = positions()
    key = "landmark" if numbered else "keypoint"
    rows = [["frame", "timestamp", key, "x", "y", "z", *(["visibility"] if likely else [])]]
    for k in range(N):
        for m, name in enumerate(MARKERS):
            row = cells(values[k, 3 * m : 3 * m + 3])
            sure = [0.125 if (k, m) in {(20, 0), (21, 0)} else 0.9] if likely else []
            rows.append([k, f"{TIMES[k]:.2f}", m if numbered else name, *row, *sure])
    names = [f"landmark_{m}" for m in range(5)] if numbered else MARKERS
    return Table("long.csv", join(rows, end="\n"), xyz(names=names), ("",) * 15, values)


def isen():
    """iSen: times before each group of angles, which may repeat."""
    values = np.round(np.random.default_rng(7).normal(size=(N, 4)).cumsum(axis=0), 5)
    values[GAP, 1:3] = np.nan
    rows = [["Tiempo", "Flexión cadera::Y", "Rotación::Y", "Tiempo", "Rotación::Y", "Giro::Y"]]
    for k in range(N):
        row = cells(values[k], digits=5)
        rows.append([f"{TIMES[k]:g}", *row[:2], f"{TIMES[k]:g}", *row[2:]])
    names = ("Flexión cadera::Y", "Rotación::Y", "Rotación::Y-2", "Giro::Y")
    return Table("isen.csv", join(rows, end="\n"), names, ("",) * 4, values)


def sleap():
    """SLEAP, with a row for each track of a frame, of which the second one is lost in the gap."""
    values = positions(n_axes=2)[:, :8]
    values[GAP] = np.nan
    values[GAP, :4] = 1.0
    parts = [f"{node}.{part}" for node in ("nose", "tail") for part in ("x", "y", "score")]
    rows = [["track", "frame_idx", "instance.score", *parts]]
    for k in range(N):
        for track in (0, 1):
            row = cells(values[k, 4 * track : 4 * track + 4])
            if row[0]:
                rows.append([f"track_{track}", k, 0.93, *row[:2], 0.9, *row[2:], 0.8])
    channels = tuple(
        f"track_{track}.{node}.{axis}"
        for track in (0, 1)
        for node in ("nose", "tail")
        for axis in "xy"
    )
    return Table("labels.csv", join(rows, end="\n"), channels, ("",) * 8, values, rate=None)


def wide():
    """freemocap's wide table: neither frames nor times, names with underscores."""
    values = positions()
    names = [f"body_{name.lower()}_{axis}" for name in MARKERS for axis in "xyz"]
    rows = [names, *(cells(values[k]) for k in range(N))]
    return Table("body_3d_xyz.csv", join(rows, end="\n"), tuple(names), ("",) * 15, values, None)


TABLES = {
    "motive 1.23": motive(titles=False),
    "motive 1.24": motive(unit="Millimeters"),
    "motive bodies": motive_bodies(),
    "nexus": nexus(),
    "nexus, zeros": nexus(zeros=True),
    "nexus, blocks": nexus(others=True),
    "nexus joints": nexus_joints(),
    "qualisys": qualisys(),
    "qualisys, empty cells": qualisys(missing=""),
    "qualisys, columns named": qualisys(columns=True, missing="NaN"),
    "qualisys 6D": qualisys_bodies(),
    "qualisys skeleton": qualisys_skeleton(),
    "deeplabcut": deeplabcut(),
    "deeplabcut, animals": deeplabcut(individuals=True),
    "opensim, tabs": opensim(),
    "opensim, commas, radians": opensim(",", "no"),
    "opensim, blanks": opensim(" "),
    "opensim quaternions": quaternions(),
    "opensim states": storage(),
    "two lines": two_lines(),
    "long": long_rows(),
    "long, numbered": long_rows(numbered=True),
    "sleap": sleap(),
    "isen": isen(),
    "freemocap": wide(),
}
