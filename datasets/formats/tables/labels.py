"""What the columns of a program's table are called: names of markers and axes, with their units."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from mocapbench.datasets.formats.tables.columns import is_index, is_likelihood
from mocapbench.datasets.formats.tables.dialects import Dialect

__all__ = ["LENGTHS", "Label", "expand_parts", "label_columns"]

LENGTHS = frozenset({"mm", "cm", "m"})
"""Units of positions."""
_LENGTH = frozenset({"x", "y", "z", "tx", "ty", "tz"})
_ANGLE = frozenset({"rx", "ry", "rz", "roll", "pitch", "yaw"})
_QUATERNION = frozenset({"qx", "qy", "qz", "qw"})
_PARTS = {"Quaternion": ("qw", "qx", "qy", "qz"), "Vec3": ("x", "y", "z")}
_WORDS = {"meters": "m", "centimeters": "cm", "millimeters": "mm", "yes": "deg", "no": "rad"}
_NAME_AND_AXIS = re.compile(r"(.*\S) (Q?[XYZ]|QW|Roll|Pitch|Yaw)", re.IGNORECASE)


class Label(NamedTuple):
    """What a column is."""

    name: str
    unit: str = ""
    left_alone: bool = False
    """Whether it is neither a position nor an angle."""


_Rows = Mapping[str, Sequence[str]]


def label_columns(dialect: Dialect, rows: _Rows, fact: Callable[[str], str]) -> list[Label]:
    """Return a label for each column.

    Parameters
    ----------
    dialect : Dialect
    rows : mapping of str to sequence of str
        The cells of the lines with ``"axes"``, ``"names"``, ``"kinds"``, ``"groups"`` and
        ``"units"``, for each column one, or none at all where there is no such line of the last
        four.
    fact : callable
        From a pattern to what the head says, or nothing.
    """
    length = _unit(fact(dialect.length_by)) or dialect.length
    units = {"length": length, "angle": _unit(fact(dialect.angle_by)) or dialect.angle, "": ""}
    if dialect.sorts:
        return _number_repetitions(_label_whole_name(dialect, name, units) for name in rows["axes"])
    if units["length"] == "px" and "z" in rows["axes"]:
        units["length"] = ""  # positions in space, of which no unit is stated
    return _number_repetitions(_label_axes(rows, units))


def expand_parts(labels: Sequence[Label], kind: str) -> list[Label]:
    """Return a label for each part of values such as quaternions; those of times have one part."""
    parts = _PARTS.get(kind, ())
    return [
        one
        for label in labels
        for one in (
            [Label(f"{label.name}.{part}") for part in parts]
            if parts and not is_index(label.name)
            else [label]
        )
    ]


def _unit(fact: str) -> str:
    return _WORDS.get(fact.lower(), "")


def _label_whole_name(dialect: Dialect, name: str, units: dict[str, str]) -> Label:
    if is_index(name):
        return Label(name)
    sort = next((sort for pattern, sort in dialect.sorts if re.fullmatch(pattern, name)), "")
    return Label(name, units[sort])


def _label_axes(rows: _Rows, units: dict[str, str]) -> list[Label]:
    """Return labels of columns of which each has an axis, and a name or that of the one before."""
    names = _names_of_columns(rows)
    kinds = rows["kinds"] or [""] * len(names)
    bodies = list(zip(rows["groups"] or [""] * len(names), names, kinds, strict=True))
    fourfold = {body for body, axis in zip(bodies, rows["axes"], strict=True) if _axis(axis) == "w"}
    labels = []
    for column, (group, name, kind) in enumerate(bodies):
        axis = _suffix(_axis(rows["axes"][column]), kind, (group, name, kind) in fourfold)
        sort = "length" if axis in _LENGTH else "angle" if axis in _ANGLE else ""
        unit = rows["units"][column] if rows["units"] else units[sort]
        if not name:
            labels.append(Label(rows["axes"][column], left_alone=True))
        elif sort or axis in _QUATERNION or is_likelihood(axis):
            labels.append(Label(".".join(filter(None, (group, name, axis))), unit))
        else:
            labels.append(Label(f"{name} {axis}".strip(), left_alone=True))
    return labels


def _names_of_columns(rows: _Rows) -> list[str]:
    """Return the name for each column; a cell without one has that before, unless it is a time."""
    found, name = [], ""
    for column, cell in enumerate(rows["axes"]):
        both = _NAME_AND_AXIS.fullmatch(cell)
        alone = _is_alone(rows["axes"], column)
        own = both[1] if both else cell if alone else ""
        name = (rows["names"][column] if rows["names"] else own) or name
        name = "" if cell and is_index(cell) else name
        found.append(name)
    return found


def _is_alone(axes: Sequence[str], column: int) -> bool:
    """Return whether a column has nothing but the name of a body, whose axes are to the right."""
    return axes[column + 1 : column + 3] == ["X", "Y"]


def _axis(cell: str) -> str:
    both = _NAME_AND_AXIS.fullmatch(cell)
    return (both[2] if both else cell).lower()


def _suffix(axis: str, kind: str, fourfold: bool) -> str:
    """Return what ends the name of a channel; that of a kind neither place nor angle is no axis."""
    if kind.lower() == "rotation":
        return ("q" if fourfold else "r") + axis
    return axis if kind.lower() in {"", "position"} else f"{axis} {kind}".strip()


def _number_repetitions(labels: Iterable[Label]) -> list[Label]:
    """Return labels of which those of repeated names have a number: ``LKNE-2.x``."""
    seen: Counter[str] = Counter()
    numbered = []
    for label in labels:
        seen[label.name] += 1
        count, (name, dot, axis) = seen[label.name], label.name.rpartition(".")
        new = f"{name}-{count}.{axis}" if dot else f"{label.name}-{count}"
        repeated = count > 1 and not (label.left_alone or is_index(label.name))
        numbered.append(label._replace(name=new) if repeated else label)
    return numbered
