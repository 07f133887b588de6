"""AMC and BVH have the motion of the recording."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mocapbench.benchmark import JointAngles
from mocapbench.benchmark.motion.joint_angles import amc_text, bvh_text
from mocapbench.datasets import (
    THESIS_CHANNELS,
    BVHFormat,
    GaitLibrary,
    gpdm_features,
    parse_motion,
    root_differences,
)

FEATURES = {
    "whole": lambda recording: recording,
    "thesis": lambda recording: recording.select(THESIS_CHANNELS),
    "gpdm": gpdm_features,
}


@pytest.fixture(params=FEATURES)
def motion(request):
    """Return a skeleton and a recording of some of its channels."""
    made = GaitLibrary().motion("02_04")
    recording = made.recording("walk").frames(range(80))
    return made.skeleton, FEATURES[request.param](recording)


def test_an_amc_file_has_the_values(motion):
    skeleton, recording = motion
    read = parse_motion(amc_text(skeleton, recording), skeleton, "walk.amc").recording("walk")
    again = root_differences(read) if "root.dtx" in recording.channels else read
    values = again.select(recording.channels).values
    # The last difference of a path repeats the one before, as it does in what is written.
    np.testing.assert_allclose(values, recording.values, rtol=0, atol=1e-9)


def positions_of(path):
    """Return where the joints and ends of a BVH file are, by name, from its text alone."""
    recording = BVHFormat().read(path)
    curves = dict(zip(recording.channels, recording.values.T, strict=True))
    found, above, offset, name = {}, [], None, ""
    for line in path.read_text().partition("MOTION")[0].splitlines():
        match line.split():
            case ["ROOT" | "JOINT", joint]:
                name = joint
            case ["End", "Site"]:
                name = f"end of {name}"
            case ["OFFSET", *numbers]:
                offset = np.array(numbers, dtype=float)
            case ["CHANNELS", *_]:
                turns = np.column_stack([curves[f"{name}.r{axis}"] for axis in "zyx"])
                own = Rotation.from_euler("ZYX", turns, degrees=True)
                if above:
                    parent, start = above[-1]
                    above.append((parent * own, start + parent.apply(offset)))
                else:
                    path_ = np.column_stack([curves[f"{name}.t{axis}"] for axis in "xyz"])
                    above.append((own, path_))
                found[name] = above[-1][1]
            case ["}"]:
                if name.startswith("end of "):
                    parent, start = above[-1]
                    found[name] = start + parent.apply(offset)
                    name = ""
                else:
                    above.pop()
    return found


def test_the_joints_of_a_bvh_file_are_where_the_body_has_them(motion, tmp_path):
    skeleton, recording = motion
    path = tmp_path / "walk.bvh"
    path.write_text(bvh_text(skeleton, recording))
    found = positions_of(path)
    expected = JointAngles(skeleton).positions(recording)
    for joint, segment in enumerate(skeleton.segments):
        children = [other.name for other in skeleton.segments if other.parent == segment.name]
        for begins_there in children or [f"end of {segment.name}"]:
            np.testing.assert_allclose(found[begins_there], expected[:, joint], atol=1e-6)


def test_a_bvh_file_has_the_times(motion, tmp_path):
    skeleton, recording = motion
    path = tmp_path / "walk.bvh"
    path.write_text(bvh_text(skeleton, recording))
    times = recording.times - recording.times[0]
    np.testing.assert_allclose(BVHFormat().read(path).times, times, atol=1e-9)
