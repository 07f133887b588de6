"""C3D files: invalid points, residuals, integers, results of models, and damaged files."""

import warnings

import ezc3d
import numpy as np
import pytest
from c3d_files import write_bytes
from format_files import markers, with_gap, write_c3d

from mocapbench.datasets import C3DFormat, FormatError, FormatWarning
from mocapbench.datasets.formats.markers.c3d_layout import find_layout
from mocapbench.datasets.formats.markers.c3d_parameters import read_parameters

C3D = C3DFormat()
RESIDUAL = 3


@pytest.fixture
def given(tmp_path):
    write_c3d(tmp_path / "given.c3d", with_gap(markers(40)))
    return tmp_path / "given.c3d"


def read_layout(path):
    return find_layout(path, read_parameters(path))


def numbers(path):
    """Return the numbers of all points, (N, numbers)."""
    return np.array(read_layout(path).points(path, "r")).reshape(40, -1)


def change(path, frame, number, value):
    read_layout(path).points(path, "r+")[frame, number // 4, number % 4] = value


def filled(path, value=0.5):
    recording = C3D.read(path)
    return recording.with_values(np.where(recording.visible, recording.values, value))


def test_markers_units_rate_and_gaps(given):
    recording, truth = C3D.read(given), with_gap(markers(40))
    assert recording.channels == truth.channels
    assert set(recording.units) == {"mm"}
    assert np.array_equal(recording.visible, truth.visible)
    assert np.array_equal(recording.values, truth.values.astype(np.float32), equal_nan=True)
    assert np.allclose(recording.times, np.arange(40) / 120)


@pytest.mark.parametrize("word", [np.nan, -1.0])
def test_a_point_without_a_valid_number_is_hidden_as_a_whole(given, word):
    change(given, 3, RESIDUAL if word == -1.0 else 1, word)
    assert C3D.read(given).visible[3].tolist() == [False] * 3 + [True] * 12


def test_a_point_at_the_origin_is_hidden_and_one_on_an_axis_is_not(given):
    for number in range(3):
        change(given, 3, number, 0.0)
        assert C3D.read(given).visible[3, 0] == (number < 2)


def test_only_filled_coordinates_and_their_residuals_change(given, tmp_path):
    out = tmp_path / "out.c3d"
    C3D.write(out, filled(given), like=given)
    before, after = numbers(given), numbers(out)
    expected = before.copy()
    expected[20:30, :4] = [0.5, 0.5, 0.5, 0.0]
    assert np.array_equal(after, expected)
    layout = read_layout(given)
    one, two = given.read_bytes(), out.read_bytes()
    assert (one[: layout.start], one[layout.end :]) == (two[: layout.start], two[layout.end :])
    analog = ezc3d.c3d(str(out))["data"]["analogs"]
    assert np.array_equal(analog, ezc3d.c3d(str(given))["data"]["analogs"])


def test_a_point_is_filled_as_a_whole_or_not_at_all(given, tmp_path):
    recording = C3D.read(given)
    values = recording.values.copy()
    values[20:30, 0] = 0.5
    C3D.write(tmp_path / "out.c3d", recording.with_values(values), like=given)
    assert np.array_equal(numbers(tmp_path / "out.c3d"), numbers(given))


def test_one_coordinate_of_a_visible_point_can_be_replaced(given, tmp_path):
    recording = C3D.read(given)
    replaced = np.zeros((40, 15), dtype=bool)
    replaced[5, 4] = True
    values = np.where(replaced, 0.5, recording.values)
    C3D.write(tmp_path / "out.c3d", recording.with_values(values), given, replaced)
    expected = numbers(given)
    expected[5, [5, 7]] = 0.5, 0.0
    assert np.array_equal(numbers(tmp_path / "out.c3d"), expected)


def as_integers(path, scale):
    """Write a file of integers to be multiplied by ``scale``."""
    write_bytes(path, with_gap(markers(40)).values.reshape(40, 5, 3), scale=scale)


def test_a_file_of_integers_keeps_them(given, tmp_path):
    as_integers(given, 0.1)
    recording = C3D.read(given)
    assert np.allclose(recording.values, with_gap(markers(40)).values, atol=0.051, equal_nan=True)
    assert read_layout(given).dtype == np.dtype("<i2")
    C3D.write(tmp_path / "out.c3d", filled(given, 12.34), like=given)
    before, after = numbers(given), numbers(tmp_path / "out.c3d")
    expected = before.copy()
    expected[20:30, :4] = [123, 123, 123, 0]
    assert np.array_equal(after, expected)


def test_a_file_of_integers_gets_the_nearest_of_what_it_can_hold(given, tmp_path):
    as_integers(given, 0.1)
    expected = r"coordinates from -3276.8 to 3276.7, .* got 30 beyond, up to -4000, which are writ"
    with pytest.warns(FormatWarning, match=expected):
        C3D.write(tmp_path / "out.c3d", filled(given, -4000.0), like=given)
    assert np.allclose(C3D.read(tmp_path / "out.c3d").values[20:30, :3], -3276.8)


@pytest.mark.parametrize("value", [3276.74, -3276.84])
def test_what_rounds_to_the_largest_is_within_it(given, tmp_path, value):
    as_integers(given, 0.1)
    with warnings.catch_warnings(action="error"):
        C3D.write(tmp_path / "out.c3d", filled(given, value), like=given)
    assert np.allclose(C3D.read(tmp_path / "out.c3d").values[20:30, :3], value, atol=0.05)


def modelled(path, group, label, unit=None):
    """Have a file name the point with a label as one of a group, whose values have a unit."""
    file = ezc3d.c3d(str(path))
    file.add_parameter("POINT", group, [label])
    file.add_parameter("POINT", "TYPE_GROUPS", ["OWN", "OWN"])
    if unit:
        file.add_parameter("POINT", f"{group.removesuffix('S')}_UNITS", [unit])
    out = path.with_name("modelled.c3d")
    file.write(str(out))
    return out


GROUPS = [("ANGLES", "deg"), ("FORCES", "N"), ("MOMENTS", "Nmm"), ("POWERS", "W"), ("OWN", "l")]


@pytest.mark.parametrize(("group", "unit"), [*GROUPS, ("SCALARS", ""), ("MODELED_MARKERS", "mm")])
def test_results_of_a_model_are_channels_of_their_own_unit(given, tmp_path, group, unit):
    names = markers().channels
    path = modelled(given, group, "lowerback", unit if group != "MODELED_MARKERS" else None)
    recording = C3D.read(path)
    assert recording.channels == names
    assert recording.units == ("mm",) * 3 + (unit,) * 3 + ("mm",) * 9
    assert C3D.results(path, names) == names[3:6]
    assert C3D.results(given, names) == ()
    change(path, 3, 4, np.nan)
    assert C3D.read(path).visible[3].tolist() == [True] * 3 + [False] * 3 + [True] * 9
    C3D.write(tmp_path / "out.c3d", filled(path), path)
    expected = numbers(path)
    expected[20:30, :4] = expected[3, 4:8] = [0.5, 0.5, 0.5, 0.0]
    assert np.array_equal(numbers(tmp_path / "out.c3d"), expected)


def test_a_subject_before_the_name_makes_no_difference(given):
    path = modelled(given, "ANGLES", "Ann:lowerback")
    assert C3D.results(path, markers().channels) == ()
    path.write_bytes(
        path.read_bytes().replace(b"upperback", b"Ann:lower").replace(b"thorax", b"Bob:lo")
    )
    path = modelled(path, "FORCES", "lower")
    assert C3D.results(path, C3D.read(path).channels) == (
        "Ann:lower.x",
        "Ann:lower.y",
        "Ann:lower.z",
    )


def test_forces_may_be_zero_and_positions_may_not(given):
    force = modelled(given, "FORCES", "lowerback", "N")
    points = read_layout(force).points(force, "r+")
    points[3, :, :3] = 0.0
    assert C3D.read(force).visible[3].tolist() == [False] * 3 + [True] * 3 + [False] * 9


def header(path, at, *values):
    data = bytearray(path.read_bytes())
    data[at : at + len(values)] = bytes(values)
    path.write_bytes(data)


def more_points(path):
    write_bytes(path, np.ones((40, 5, 3)), header={2: 99}, parameters={"POINT:USED": None})


WRONG = {
    "an empty file": (lambda p: p.write_bytes(b""), "the header of a C3D file, got an empty file"),
    "another file": (
        lambda p: p.write_bytes(b"time,hip\n" * 99),
        "the header of a C3D file, got b't",
    ),
    "cut short": (
        lambda p: p.write_bytes(p.read_bytes()[:3000]),
        "as its header says, got 3000; the file is cut short",
    ),
    "no computer": (lambda p: header(p, 515, 9), r"DEC or MIPS computers .*, got the type 9; exp"),
    "more points": (more_points, "expected [0-9]{5} bytes, as its header says, got [0-9]{4}; the"),
}


@pytest.mark.parametrize("damage", WRONG)
def test_what_is_wrong_is_said_plainly(given, damage):
    harm, complaint = WRONG[damage]
    harm(given)
    with pytest.raises(FormatError, match=complaint):
        C3D.read(given)


def test_a_file_without_a_rate_can_be_given_one(given):
    write_bytes(given, np.ones((40, 5, 3)), rate=0.0)
    with pytest.raises(FormatError, match="expected a positive frame rate, got 0; name the rate"):
        C3D.read(given)
    assert C3D.read(given, rate=50.0).times[1] == 0.02
