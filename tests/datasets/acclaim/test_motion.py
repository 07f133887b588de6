"""Motions: reading, writing and reading back, and errors with their lines."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mocapbench.datasets import (
    AcclaimError,
    Motion,
    TruncatedFrameWarning,
    format_motion,
    parse_motion,
    read_motion,
)

SEGMENTS = ("root", "thigh", "arm", "shin")


@pytest.fixture
def motion(skeleton, motion_text):
    return parse_motion(motion_text, skeleton, "toy.amc")


def test_values_are_in_the_order_of_the_file(motion):
    assert motion.segments == SEGMENTS
    assert motion.channels[5:] == (
        *("root.rz", "thigh.rx", "thigh.ry", "thigh.rz", "arm.ry", "arm.rz", "shin.rx"),
    )
    assert motion.values.shape == (3, 12)
    np.testing.assert_array_equal(motion.values[0], [1, 2, 3, 10, 20, 30, -20, 5, 1, 15, -75, 40])
    np.testing.assert_array_equal(motion.values[1, 6:], [-21, 5.5, 1e-15, 16, -75, 41])


def test_a_recording_of_it_runs_at_120_frames_a_second(motion):
    recording = motion.recording("toy")
    np.testing.assert_allclose(recording.times, [0, 1 / 120, 2 / 120])
    assert recording.units == ("", "", "", *("deg",) * 9)
    np.testing.assert_array_equal(recording.values, motion.values)


def test_carriage_returns_and_a_missing_last_line_end_make_no_difference(
    skeleton, motion, motion_text
):
    for text in (motion_text.replace("\n", "\r\n"), motion_text.rstrip(), motion_text + "\n\n"):
        np.testing.assert_array_equal(parse_motion(text, skeleton, "").values, motion.values)


def test_radians_become_degrees_and_translations_stay(skeleton, motion, motion_text):
    radians = parse_motion(motion_text.replace(":DEGREES", ":RADIANS"), skeleton, "")
    np.testing.assert_allclose(radians.values[:, 3:], np.rad2deg(motion.values[:, 3:]))
    np.testing.assert_array_equal(radians.values[:, :3], motion.values[:, :3])


def test_frames_may_begin_at_any_number(skeleton, motion, motion_text):
    text = (
        motion_text.replace("\n1\n", "\n8\n").replace("\n2\n", "\n9\n").replace("\n3\n", "\n10\n")
    )
    np.testing.assert_array_equal(parse_motion(text, skeleton, "").values, motion.values)


def test_the_largest_number_of_a_first_frame_is_counted_on_from(skeleton, motion, motion_text):
    text = motion_text.replace("\n1\n", "\n999999999\n").replace("\n2\n", "\n1000000000\n")
    text = text.replace("\n3\n", "\n1000000001\n")
    np.testing.assert_array_equal(parse_motion(text, skeleton, "").values, motion.values)


@given(
    arrays(np.float64, st.tuples(st.integers(1, 5), st.just(12)), elements=st.floats(-1e99, 1e99)),
    st.permutations(SEGMENTS),
)
def test_writing_and_reading_gives_the_same(skeleton, values, segments):
    motion = Motion(skeleton, tuple(segments), values)
    back = parse_motion(format_motion(motion), skeleton, "")
    assert back.segments == motion.segments
    np.testing.assert_array_equal(back.values, values)


@pytest.mark.parametrize("lines", [1, 2, 3, 4])
def test_a_last_frame_that_was_cut_short_is_dropped_with_a_warning(
    skeleton, motion, motion_text, lines
):
    text = "\n".join(motion_text.rstrip().split("\n")[:-lines])
    with pytest.warns(TruncatedFrameWarning, match=f"lacks {lines} of its 4 segments"):
        short = parse_motion(text, skeleton, "toy.amc")
    np.testing.assert_array_equal(short.values, motion.values[:2])


@pytest.mark.parametrize(
    ("change", "line", "expected"),
    [
        ((":FULLY-SPECIFIED\n", ""), 3, ":FULLY-SPECIFIED"),
        ((":DEGREES\n", ""), 3, ":DEGREES"),
        ((":DEGREES\n", ":DEGREES\n:RADIANS\n"), 5, "one of"),
        ((":DEGREES\n", ":DEGREES\n:COMPRESSED\n"), 5, "header"),
        (("\n1\nroot", "\nroot"), 4, "the number of the first frame"),
        (("\n1\n", "\n1 2\n"), 4, "the number of the first frame"),
        (("\n1\n", "\n²\n"), 4, "the number of the first frame"),
        (("\n1\n", "\none\n"), 4, "the number of the first frame"),
        (("\n1\n", "\n1000000000\n"), 4, "the number of the first frame, of at most 9 digits"),
        (("\n1\n", f"\n{'1' * 5000}\n"), 4, "the number of the first frame, of at most 9 digits"),
        ((":DEGREES\n", ":DEGREES\n" * 50_000), 5, "header"),
        (("\n2\n", "\n3\n"), 9, "frame number 2"),
        (("\n2\n", "\n02\n"), 9, "frame number 2"),
        (("thigh -20 5 1", "thigh -20 5"), 6, "'thigh' with 3 finite numbers"),
        (("thigh -20 5 1", "thigh -20 5 1 1"), 6, "'thigh' with 3 finite numbers"),
        (("thigh -20 5 1", "thigh -20 5 nan"), 6, "finite"),
        (("thigh -20 5 1", "thigh -20 5 inf"), 6, "finite"),
        (("thigh -20 5 1", "thigh -20 5 1e400"), 6, "finite"),
        (("thigh -20 5 1", "thigh -20 5 1e200"), 6, "-1e+100 to 1e+100"),
        (("thigh -22", "thigh twenty"), 16, "finite"),
        (("arm 15 -75", "wing 15 -75"), 7, "that remain: arm"),
        (("arm 15 -75", "thigh -20 5 1"), 7, "that remain: arm"),
        (("arm 15 -75\n", ""), 8, "that remain: arm"),
        (("arm 16 -7.5e+001", "wing 16 -75"), 12, "'arm'"),
        (("arm 16 -7.5e+001\n", ""), 12, "'arm'"),
        (("arm 16 -7.5e+001", "hip 1"), 12, "'arm'"),
        (("shin 41\n", "shin 41\n\n"), 14, "frame number 3"),
        (("shin 42", "shin"), 18, "'shin' with 1 finite numbers"),
    ],
)
def test_errors_name_the_line(skeleton, motion_text, change, line, expected):
    assert change[0] in motion_text
    with pytest.raises(AcclaimError) as caught:
        parse_motion(motion_text.replace(*change, 1), skeleton, "toy.amc")
    assert (caught.value.file, caught.value.line) == ("toy.amc", line)
    assert expected in caught.value.expected


def test_a_header_without_frames_and_a_single_short_frame_are_refused(skeleton, motion_text):
    for n_lines, line in ((3, 4), (6, 7)):
        with pytest.raises(AcclaimError) as caught:
            parse_motion("\n".join(motion_text.split("\n")[:n_lines]), skeleton, "toy.amc")
        assert caught.value.line == line


@given(st.randoms(use_true_random=False))
def test_mutated_files_raise_acclaim_errors(tmp_path_factory, skeleton, motion_text, mutated, rng):
    path = tmp_path_factory.mktemp("fuzz") / "mutated.amc"
    path.write_bytes(mutated(motion_text.encode(), rng))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TruncatedFrameWarning)
        try:
            assert np.isfinite(read_motion(path, skeleton).values).all()
        except AcclaimError as error:
            assert error.file == str(path)


@pytest.mark.parametrize(
    ("segments", "values", "expected"),
    [
        (("root", "thigh", "arm"), np.zeros((2, 11)), "expected the segments"),
        ((*SEGMENTS, "arm"), np.zeros((2, 12)), "expected the segments"),
        (SEGMENTS, np.zeros((2, 11)), "shape"),
        (SEGMENTS, np.zeros(12), "shape"),
        (SEGMENTS, np.full((2, 12), np.nan), "finite"),
    ],
)
def test_a_motion_fits_its_skeleton(skeleton, segments, values, expected):
    with pytest.raises(ValueError, match=expected):
        Motion(skeleton, segments, values)


def test_a_motion_cannot_be_changed(motion):
    with pytest.raises(ValueError, match="read-only"):
        motion.values[0, 0] = 1.0


@pytest.mark.recordings
def test_real_recordings_are_read_whatever_their_line_ends(cmu):
    n_frames = {"cmu:02_01": 343, "cmu:11_01": 597, "cmu:12_01": 523}
    for uri, n in n_frames.items():
        assert cmu.recording(uri).values.shape == (n, 62)


@pytest.mark.recordings
def test_the_frame_that_the_capture_cut_short_is_dropped(cmu):
    with pytest.warns(TruncatedFrameWarning, match="lacks 1 of its 29 segments"):
        recording = cmu.recording("cmu:07_12")
    assert recording.values.shape == (244, 62)


@pytest.mark.recordings
def test_real_values_are_those_in_the_file(cmu):
    recording = cmu.recording("cmu:35_02")
    lines = Path(cmu.libraries["cmu"].where("35_02")).read_text().split("\n")
    frame = lines[lines.index("100") + 1 : lines.index("101")]
    words = [word for line in frame for word in line.split()[1:]]
    assert recording.values[99].tolist() == list(map(float, words))
