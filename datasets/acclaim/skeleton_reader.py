"""Reading Acclaim skeleton files (.asf), strictly.

Masses, joint limits and documentation are skipped, as the benchmark does not use them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import degrees
from pathlib import Path

from mocapbench.datasets.acclaim.blocks import blocks, read_fields, sections
from mocapbench.datasets.acclaim.errors import AcclaimError
from mocapbench.datasets.acclaim.skeleton import Segment, Skeleton, Vector
from mocapbench.datasets.acclaim.text import Line, name_list, read_text

__all__ = ["parse_skeleton", "read_skeleton"]

_MAX_BYTES = 2**20  # a file of the CMU database has 7,000
_BONE_FIELDS = {"name", "direction", "length", "axis"}
_MORE_BONE_FIELDS = {"dof", "id", "limits", "bodymass", "cofmass"}
_ROOT_FIELDS = {"order", "axis", "position", "orientation"}
_DEGREES_PER = {"deg": 1.0, "rad": degrees(1.0)}
_ROTATIONS = {"rx", "ry", "rz"}
_TRANSLATIONS = {"tx", "ty", "tz"}


def read_skeleton(path: str | Path) -> Skeleton:
    """Read an .asf file.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    Skeleton
        Angles in degrees, lengths in the file's unit.

    Raises
    ------
    AcclaimError
        If the file is missing, malformed or larger than 1 MiB.

    Notes
    -----
    Reading takes at most 0.13 MB of memory and 80 bytes for each byte of the file, whatever it
    contains; files of the CMU database take 13 for each byte.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import GaitLibrary, format_skeleton, read_skeleton
    >>> with TemporaryDirectory() as folder:
    ...     asf = Path(folder, "01.asf")
    ...     _ = asf.write_text(format_skeleton(GaitLibrary().skeleton("01_01")))
    ...     skeleton = read_skeleton(asf)
    >>> skeleton.segments[2].name, skeleton.segments[2].dof
    ('upperback', ('rx', 'ry', 'rz'))
    """
    try:
        return parse_skeleton(read_text(path, _MAX_BYTES), str(path))
    except AcclaimError as problem:
        # The frames of the parser would keep the whole file in memory as long as the error.
        raise problem.with_traceback(None) from problem.__cause__


def parse_skeleton(text: str, file: str) -> Skeleton:
    """Parse the text of an .asf file.

    Parameters
    ----------
    text : str
        Content of the file.
    file : str
        Name of the file in error messages.

    Raises
    ------
    AcclaimError
        If the text is malformed.
    """
    found = sections(text, file)
    for name in (":name", ":units", ":root", ":bonedata", ":hierarchy"):
        if name not in found:
            raise AcclaimError(file, None, f"a section {name!r}", "none")
    units = read_fields(found[":units"], {"length", "angle"}, {"mass"})
    degrees_per_unit = _lookup(units["angle"], _DEGREES_PER)
    segments = {"root": _root(read_fields(found[":root"], _ROOT_FIELDS))}
    for block in blocks(found[":bonedata"]):
        segment = _segment(read_fields(block, _BONE_FIELDS, _MORE_BONE_FIELDS), degrees_per_unit)
        if segment.name in segments:
            raise block[0].error(f"a segment other than {segment.name!r}, which is defined above")
        segments[segment.name] = segment
    name = " ".join(found[":name"][0].words[1:])
    return Skeleton(name, _positive(units["length"]), _hang(found[":hierarchy"], segments))


def _root(fields: Mapping[str, Line]) -> Segment:
    for name in ("position", "orientation"):
        if any(_vector(fields[name])):
            raise fields[name].error(f"'{name} 0 0 0', as other rest poses are not supported")
    dof = tuple(word.lower() for word in fields["order"].words[1:])
    if sorted(dof) != sorted(_ROTATIONS | _TRANSLATIONS):
        raise fields["order"].error("'order' with TX TY TZ RX RY RZ in some order")
    zero = (0.0, 0.0, 0.0)
    return Segment("root", "", zero, 0.0, zero, _rotation_order(fields["axis"], 1), dof)


def _segment(fields: Mapping[str, Line], degrees_per_unit: float) -> Segment:
    axis = tuple(degrees_per_unit * angle for angle in fields["axis"].floats(1, 4))
    dof = fields["dof"].words[1:] if "dof" in fields else ()
    if not _ROTATIONS.issuperset(dof) or len(set(dof)) != len(dof):
        raise fields["dof"].error("'dof' with some of rx, ry, rz, each once")
    return Segment(
        name=_word(fields["name"]),
        parent="",
        direction=_vector(fields["direction"]),
        length=_positive(fields["length"]),
        axis=axis,
        order=_rotation_order(fields["axis"], 4),
        dof=dof,
    )


def _hang(section: Sequence[Line], segments: Mapping[str, Segment]) -> tuple[Segment, ...]:
    """Return the segments with their parents, in the order in which the hierarchy names them."""
    placed = {"root": segments["root"]}
    for line in (line for block in blocks(section) for line in block[1:]):
        parent, *children = line.words
        if parent not in placed:
            raise line.error("a parent that is 'root' or the child of a line above")
        for child in children:
            if child not in segments or child in placed:
                raise line.error("children that ':bonedata' defines, each with one parent")
            placed[child] = replace(segments[child], parent=parent)
    lost = sorted(segments.keys() - placed.keys())
    if lost:
        raise section[0].error(f"a place in the hierarchy for {name_list(lost)}")
    return tuple(placed.values())


def _vector(line: Line) -> Vector:
    if len(line.words) != 4:
        raise line.error(f"{line.words[0]!r} with 3 numbers")
    return line.floats(1, 4)


def _positive(line: Line) -> float:
    (value,) = line.floats(1, 2)
    if value <= 0 or len(line.words) != 2:
        raise line.error(f"{line.words[0]!r} with one positive number")
    return value


def _word(line: Line) -> str:
    if len(line.words) != 2:
        raise line.error(f"{line.words[0]!r} with one word")
    return line.words[1]


def _lookup(line: Line, choices: Mapping[str, float]) -> float:
    if _word(line) not in choices:
        raise line.error(f"{line.words[0]!r} with one of {', '.join(choices)}")
    return choices[_word(line)]


def _rotation_order(line: Line, position: int) -> str:
    order = "".join(line.words[position:]).upper()
    if sorted(order) != ["X", "Y", "Z"]:
        raise line.error(f"{line.words[0]!r} with an order of rotations such as XYZ")
    return order
