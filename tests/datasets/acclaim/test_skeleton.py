"""Skeletons: reading, writing and reading back, and errors with their lines."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.datasets import (
    AcclaimError,
    Segment,
    Skeleton,
    format_skeleton,
    parse_skeleton,
    read_skeleton,
)

ZERO = (0.0, 0.0, 0.0)
ROOT = Segment("root", "", ZERO, 0.0, ZERO, "XYZ", ("tx", "ty", "tz", "rx", "ry", "rz"))


def test_segments_come_in_the_order_of_the_hierarchy(skeleton):
    assert [segment.name for segment in skeleton.segments] == [
        *("root", "hip", "arm", "thigh", "shin")
    ]
    assert skeleton.parents == (-1, 0, 0, 1, 3)
    assert skeleton.name == "TOY"


def test_a_segment_is_read_whole(skeleton):
    assert skeleton.segments[2] == Segment(
        "arm", "root", (0.6, 0.8, 0.0), 5.0, (180.0, 30.0, -90.0), "XYZ", ("ry", "rz")
    )


def test_moving_segments_are_those_with_degrees_of_freedom(skeleton):
    assert skeleton.moving == {
        "root": ("tx", "ty", "tz", "rx", "ry", "rz"),
        "arm": ("ry", "rz"),
        "thigh": ("rx", "ry", "rz"),
        "shin": ("rx",),
    }


def test_the_unit_of_length_is_an_inch_over_the_stated_number(skeleton):
    assert skeleton.centimetres_per_unit == pytest.approx(5.08)


def test_carriage_returns_make_no_difference(skeleton, skeleton_text):
    assert parse_skeleton(skeleton_text.replace("\n", "\r\n"), "toy.asf") == skeleton


def test_radians_become_degrees(skeleton, skeleton_text):
    text = skeleton_text.replace("angle deg", "angle rad").replace(
        "180 30 -90", f"{math.pi} {math.pi / 6} {-math.pi / 2}"
    )
    assert parse_skeleton(text, "").segments[2].axis == pytest.approx(skeleton.segments[2].axis)


numbers = st.floats(-1e6, 1e6)
vectors = st.tuples(numbers, numbers, numbers)
positive = st.floats(1e-6, 1e6)
dofs = st.permutations(["rx", "ry", "rz"]).flatmap(
    lambda order: st.integers(0, 3).map(lambda n: tuple(order[:n]))
)


@st.composite
def skeletons(draw):
    segments = [ROOT]
    for number in range(draw(st.integers(0, 6))):
        parent = draw(st.sampled_from(segments)).name
        order = "".join(draw(st.permutations("XYZ")))
        bone = (draw(vectors), draw(positive), draw(vectors), order, draw(dofs))
        segments.append(Segment(f"s{number}", parent, *bone))
    return Skeleton("any name", draw(positive), tuple(segments))


@given(skeletons())
def test_writing_and_reading_gives_the_same(any_skeleton):
    assert parse_skeleton(format_skeleton(any_skeleton), "") == any_skeleton


@pytest.mark.parametrize(
    ("old", "new", "line", "expected"),
    [
        (":version", "version", 2, "a section"),
        (":bonedata", ":name", 15, "every section once"),
        (":bonedata", ":bones", None, "':bonedata'"),
        (":hierarchy", ":tree", None, "':hierarchy'"),
        ("length 0.5", "length zero", 6, "finite numbers"),
        ("length 0.5", "length -1", 6, "positive"),
        ("length 0.5", "", 4, "a line 'length'"),
        ("angle deg", "angle grad", 7, "deg, rad"),
        ("mass 1.0", "weight 1.0", 5, "mass"),
        ("order TX TY TZ RX RY RZ", "order TX TY TZ RX RY", 11, "TX TY TZ RX RY RZ"),
        ("axis XYZ\n", "axis XYY\n", 12, "XYZ"),
        ("position 0 0 0", "position 0 1 0", 13, "0 0 0"),
        ("position 0 0 0", "position 0 0", 13, "3 numbers"),
        ("name hip", "name hip joint", 18, "one word"),
        ("name thigh", "name hip", 23, "defined above"),
        ("name thigh", "name root", 23, "defined above"),
        ("name thigh", "", 23, "a line 'name'"),
        ("direction 1 0 0", "direction 1 0 nan", 19, "finite"),
        ("direction 1 0 0", "direction 1 0", 19, "3 numbers"),
        ("length 2", "length 2 3", 20, "one positive number"),
        ("axis 0 0 0 XYZ", "axis 0 0 XYZ", 21, "3 finite numbers"),
        ("dof ry rz", "dof ry ry", 49, "each once"),
        ("dof ry rz", "dof ry l", 49, "rx, ry, rz"),
        ("id 4", "colour red", 44, "one of"),
        ("id 4", "name arm", 45, "one of"),
        ("root hip arm", "root hip", 51, "a place in the hierarchy for arm"),
        ("root hip arm", "root hip arm arm", 53, "one parent"),
        ("root hip arm", "root hip arm leg", 53, "defines"),
        ("hip thigh", "foot thigh", 54, "a parent"),
        ("thigh shin\n  end", "thigh shin", 55, "'end'"),
        ("  begin\n     id 3", "     id 3", 34, "'begin'"),
    ],
)
def test_errors_name_the_line(skeleton_text, old, new, line, expected):
    assert old in skeleton_text
    with pytest.raises(AcclaimError) as caught:
        parse_skeleton(skeleton_text.replace(old, new, 1), "toy.asf")
    assert (caught.value.file, caught.value.line) == ("toy.asf", line)
    assert expected in caught.value.expected


@given(st.randoms(use_true_random=False))
def test_mutated_files_raise_acclaim_errors(tmp_path_factory, skeleton_text, mutated, rng):
    path = tmp_path_factory.mktemp("fuzz") / "mutated.asf"
    path.write_bytes(mutated(skeleton_text.encode(), rng))
    try:
        assert read_skeleton(path).segments[0] == ROOT
    except AcclaimError as error:
        assert error.file == str(path)
