"""C3D files whose header and parameters disagree: what fits the file's size is read, or nothing."""

import re
import warnings

import c3d
import numpy as np
import pytest
from c3d_files import EACH, N_ANALOGUE, number, text, word, write_bytes
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.datasets import C3DFormat, FormatError
from mocapbench.datasets.formats.markers.c3d_layout import find_layout
from mocapbench.datasets.formats.markers.c3d_parameters import read_parameters

C3D = C3DFormat()
TOTAL = N_ANALOGUE * EACH


def positions(n_frames=40, n_points=4):
    values = np.random.default_rng(0).uniform(-900, 900, (n_frames, n_points, 3))
    values[10:20, 1] = np.nan
    return np.round(values / 0.125) * 0.125


WRONG = {
    "ANALOG:USED is 0": ({}, {"ANALOG:USED": word("Intel", 0), "ANALOG:RATE": number("Intel", 0)}),
    "ANALOG:USED has the bytes of its word swapped": ({}, {"ANALOG:USED": word("Intel", 0x0300)}),
    "ANALOG:USED counts all numbers of a frame": ({}, {"ANALOG:USED": word("Intel", TOTAL)}),
    "no group ANALOG": ({}, {"ANALOG:USED": None, "ANALOG:RATE": None}),
    "the header counts analogue channels": ({3: N_ANALOGUE}, {}),
    "the header counts no analogue numbers": ({3: 0, 10: 0}, {}),
    "the header counts other points": ({2: 9}, {}),
    "POINT:USED counts other points": ({}, {"POINT:USED": word("Intel", 9)}),
    "no POINT:USED": ({}, {"POINT:USED": None}),
    "the header counts a frame more": ({5: 41}, {}),
    "the header counts no frames": ({4: 0, 5: 65535}, {}),
    "POINT:FRAMES counts a frame more": ({}, {"POINT:FRAMES": word("Intel", 41)}),
    "POINT:FRAMES is a floating-point number": ({5: 9}, {"POINT:FRAMES": number("Intel", 40)}),
    "POINT:DATA_START is 0": ({}, {"POINT:DATA_START": word("Intel", 0)}),
    "POINT:DATA_START is another": ({}, {"POINT:DATA_START": word("Intel", 3)}),
    "the header has no start of data": ({9: 0}, {}),
    "the header has another start of data": ({9: 3}, {}),
    "the header says floating-point numbers": ({7: 0, 8: 0xBF80}, {}),
    "POINT:SCALE says floating-point numbers": ({}, {"POINT:SCALE": number("Intel", -0.125)}),
    "no POINT:SCALE": ({}, {"POINT:SCALE": None}),
    "the header has no scale": ({7: 0, 8: 0}, {}),
    "no POINT:RATE": ({}, {"POINT:RATE": None}),
    "the header has no rate": ({11: 0, 12: 0}, {}),
    "no POINT:LABELS": ({}, {"POINT:LABELS": None}),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_fits_the_size_of_the_file_is_read(wrong, tmp_path):
    header, parameters = WRONG[wrong]
    path = write_bytes(
        tmp_path / "given.c3d", positions(), scale=0.125, header=header, parameters=parameters
    )
    recording = C3D.read(path)
    assert np.array_equal(recording.values.reshape(40, 4, 3), positions(), equal_nan=True)
    assert recording.times[1] == 0.01
    filled = recording.with_values(np.where(recording.visible, recording.values, 1.5))
    C3D.write(tmp_path / "out.c3d", filled, like=path)
    expected = np.where(np.isnan(positions()), 1.5, positions())
    assert np.array_equal(C3D.read(tmp_path / "out.c3d").values.reshape(40, 4, 3), expected)


@settings(max_examples=100)
@given(
    place=st.sampled_from([2, 3, 9, 10]),
    value=st.integers(0, 60),
    analogue=st.integers(0, 9),
    extra=st.integers(0, 3),
)
def test_coordinates_are_right_or_doubted(tmp_path_factory, place, value, analogue, extra):
    path = tmp_path_factory.mktemp("c3d") / "given.c3d"
    # Where the header's count is wrong, the parameter's is right: nobody can tell if both err.
    wrong = {"ANALOG:USED": word("Intel", N_ANALOGUE if place == 3 else analogue)}
    write_bytes(path, positions(), header={place: value}, parameters=wrong)
    path.write_bytes(path.read_bytes() + bytes(512 * extra))
    try:
        with warnings.catch_warnings(action="error"):
            values = C3D.read(path).values
    except (FormatError, UserWarning):
        return
    assert np.array_equal(values.reshape(40, 4, 3), positions(), equal_nan=True)


def test_a_disagreement_that_nothing_decides_is_refused_with_both_counts(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions(), header={3: 5})
    path.write_bytes(path.read_bytes() + b"more" * 512)
    complaint = (
        r"given\.c3d: expected header and parameters that agree, or of which one fits the file's "
        r"\d+ bytes, got analogue numbers a frame: 5 in its header, 6 in ANALOG:USED and its "
        r"header; export the recording again as C3D"
    )
    with pytest.raises(FormatError, match=complaint):
        C3D.read(path)


def test_counts_that_disagree_and_leave_a_part_of_a_block_are_refused(tmp_path):
    parameters = {"ANALOG:USED": word("Intel", 2)}
    path = write_bytes(tmp_path / "given.c3d", positions(), header={3: 0}, parameters=parameters)
    with pytest.raises(FormatError, match="analogue numbers a frame: 0 in its header, 4 in ANALO"):
        C3D.read(path)


def test_blocks_of_zeros_may_follow_and_others_may_not(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions())
    data = path.read_bytes()
    path.write_bytes(data + bytes(70_000))
    assert C3D.read(path).values.shape == (40, 12)
    path.write_bytes(data + b"more" * 512)
    with pytest.warns(UserWarning, match=r"expected no more than \d+ bytes, as its header says, g"):
        assert C3D.read(path).values.shape == (40, 12)


def test_the_last_block_may_be_cut_after_the_last_frame_and_not_before(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions(), pad=False)
    assert np.array_equal(C3D.read(path).visible.reshape(40, 4, 3), ~np.isnan(positions()))
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(FormatError, match=r"expected \d+ bytes, as its header says, got \d+; the"):
        C3D.read(path)


def test_parameters_may_stand_elsewhere(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions(), parameter_block=7, between=9)
    assert np.array_equal(
        C3D.read(path).values.reshape(40, 4, 3), positions().astype("f4"), equal_nan=True
    )


def test_parameters_may_stand_behind_the_data(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions(), parameters={"POINT:DATA_START": None})
    data = path.read_bytes()
    start = find_layout(path, read_parameters(path)).start
    head = bytearray(data[:512])
    head[0], head[16:18] = 2 + (len(data) - start) // 512, word("Intel", 2)[2]
    path.write_bytes(bytes(head) + data[start:] + data[512:start])
    with warnings.catch_warnings(action="error"):
        assert C3D.read(path).visible.sum() == 3 * 150


def test_rotations_may_follow_the_points(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", positions())
    block = len(path.read_bytes()) // 512 + 1
    rotations = {"ROTATION:DATA_START": word("Intel", block)}
    path = write_bytes(tmp_path / "given.c3d", positions(), parameters=rotations)
    path.write_bytes(path.read_bytes() + b"more" * 512)
    with warnings.catch_warnings(action="error"):
        assert C3D.read(path).visible.sum() == 3 * 150


def test_two_rates_are_said_and_the_parameter_is_taken(tmp_path):
    rates = {"POINT:RATE": number("Intel", 50.0)}
    path = write_bytes(tmp_path / "given.c3d", positions(), parameters=rates)
    with pytest.warns(UserWarning, match=r"got 50 in POINT:RATE and 100 in the header; the first"):
        assert C3D.read(path).times[1] == 0.02


def test_two_scales_are_said_and_that_of_the_header_is_taken(tmp_path):
    scales = {"POINT:SCALE": number("Intel", 0.5)}
    path = write_bytes(tmp_path / "given.c3d", positions(), scale=0.125, parameters=scales)
    with pytest.warns(UserWarning, match=r"got 0\.125 in the header and 0\.5 in POINT:SCALE; the"):
        assert np.nanmax(np.abs(C3D.read(path).values)) == np.nanmax(np.abs(positions()))


LONG = 65_600
SAID = {
    "POINT:LONG_FRAMES": {"POINT:LONG_FRAMES": number("Intel", LONG)},
    "POINT:LONG_FRAMES in words": {"POINT:LONG_FRAMES": word("Intel", LONG % 65536, 1)},
    "POINT:FRAMES": {"POINT:FRAMES": number("Intel", LONG)},
    "TRIAL": {
        "TRIAL:ACTUAL_START_FIELD": word("Intel", 1, 0),
        "TRIAL:ACTUAL_END_FIELD": word("Intel", LONG % 65536, LONG // 65536),
    },
}


def long_positions():
    return np.arange(1.0, LONG + 1)[:, None, None] % 3000 + np.arange(3.0)


@pytest.mark.parametrize("where", SAID)
@pytest.mark.parametrize("last", [65535, LONG % 65536])
def test_frames_beyond_what_the_header_counts(where, last, tmp_path):
    path = write_bytes(
        tmp_path / "long.c3d", long_positions(), scale=1.0, header={5: last}, parameters=SAID[where]
    )
    recording = C3D.read(path)
    assert np.array_equal(recording.values, long_positions()[:, 0])
    if where == "TRIAL":
        with path.open("rb") as stream:
            assert c3d.Reader(stream).frame_count == LONG


def test_frames_that_nothing_counts_are_refused(tmp_path):
    path = write_bytes(tmp_path / "long.c3d", long_positions(), scale=1.0)
    with pytest.raises(FormatError, match="expected the number of frames in POINT:LONG_FRAMES or"):
        C3D.read(path)


def test_labels_beyond_255_stand_in_more_parameters(tmp_path):
    values = np.ones((2, 300, 3))
    labels = [f"M{k:03}" for k in range(300)]
    parts = {"POINT:LABELS": text(*labels[:255]), "POINT:LABELS2": text(*labels[255:])}
    parts |= {"POINT:DESCRIPTIONS": None}
    path = write_bytes(tmp_path / "given.c3d", values, parameters=parts)
    assert [name[:-2] for name in C3D.read(path).channels[::3]] == labels


def test_labels_lack_repeat_and_have_blanks(tmp_path):
    path = write_bytes(tmp_path / "given.c3d", np.ones((2, 5, 3)), labels=["A ", "A", "  B\0"])
    names = [name[:-2] for name in C3D.read(path).channels[::3]]
    assert names == ["A", "A-2", "B", "unlabelled", "unlabelled-2"]


def test_results_of_a_model_are_known_with_and_without_the_subject(tmp_path):
    labels = ["Anna:HIP", "Anna:KNEE_A", "Anna:KNEE_F", "Bob:KNEE_A", "HAND"]
    results = {
        "POINT:ANGLES": text("KNEE_A", "", width=12),
        "POINT:TYPE_GROUPS": (-1, [12, 2, 2], b"USERMOS     N           MODELED_MARKm           "),
        "POINT:USERMOS": text("Anna:KNEE_F", width=12),
        "POINT:LABELS": text(*labels, width=12),
    }
    path = write_bytes(tmp_path / "given.c3d", np.ones((2, 5, 3)), labels=[], parameters=results)
    named = C3D.results(path, C3D.read(path).channels)
    assert named[::3] == ("Anna:KNEE_A.x", "Anna:KNEE_F.x", "Bob:KNEE_A.x")


@pytest.mark.parametrize("computer", ["Intel", "DEC", "MIPS"])
def test_a_file_of_force_plates_alone_is_no_recording_of_motion(computer, tmp_path):
    labels = {"POINT:LABELS": None, "POINT:DESCRIPTIONS": None}
    path = write_bytes(tmp_path / "given.c3d", np.zeros((9, 0, 3)), computer, parameters=labels)
    with pytest.raises(
        FormatError, match="positions of points, got analogue samples alone; export"
    ):
        C3D.read(path)


def test_a_file_of_no_scale_is_refused(tmp_path):
    path = write_bytes(
        tmp_path / "given.c3d", positions(), header={7: 0, 8: 0}, parameters={"POINT:SCALE": None}
    )
    with pytest.raises(FormatError, match=re.escape("expected a scale of coordinates in its head")):
        C3D.read(path)
