"""What the columns of a table are, by their names: times, frames, likelihoods, or channels."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from mocapbench.datasets.formats.errors import TextColumnsWarning

__all__ = [
    "TableColumns",
    "is_index",
    "is_likelihood",
    "is_time",
    "sort_columns",
    "split_unit",
    "time_unit",
    "warn_of_text",
]

_TIME = re.compile(
    r"""(?:(?:elapsed|relative|capture|recording|video|unix|epoch|system|camera|frame|date|utc|
    local)[ _]?)?
    (?:time(?:[ _]?stamp)?s?|t|sec(?:ond)?s?|tiempo|temps|zeit)
    (?:[ _]*[\[(]?(?:utc|gmt|local)[\])]?)?
    (?:[ _]*[\[(]?\s*(s|sec|secs|seconds?|ms|msec|milliseconds?|[uµμ]s|microseconds?|ns|
    nanoseconds?)\s*[\])]?)?""",
    re.VERBOSE,
)
_FRAME = re.compile(
    r"(?:frame|field)s?(?:[ _]?(?:#|idx|index|id|no\.?|nr\.?|num|number))?|coords|fnum"
)
_COUNT = frozenset({"", "__index_level_0__", "sub frame", "subframe", "sub_frame", "unnamed: 0"})
"""Counts of pandas, and of samples within a frame."""
_QUALITY = re.compile(
    r"instance\.score|(?:.*[._: -])?(?:(?:reprojection[_ ]?)?error|ncams)", re.IGNORECASE
)
"""How well something was found, of SLEAP, freemocap and Anipose."""
_SURE = r"likelihood|visibility|presence|confidence|conf|score|prob(?:ability)?"
_LIKELIHOOD = re.compile(rf"(?:(.*?)[._: -])?(?:{_SURE})(_?\d+)?|v(_?\d+)", re.IGNORECASE)
_COORDINATE = re.compile(r"(?:(.*?)[._: -])?[xyz](_?\d+)?", re.IGNORECASE)
_SYNONYMS = {"°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad"}
_KNOWN = "|".join(["deg", "rad", "mm", "cm", "m", *_SYNONYMS])
_IN_BRACKETS = re.compile(r"(.*\S)\s*\[([^\]]*)\]")
_IN_PARENTHESES = re.compile(rf"(.*\S)\s*\(\s*((?:{_KNOWN})(?:/s)?)\s*\)", re.IGNORECASE)
"""Only known units, since a name may be such as ``knee (left)``."""


class TableColumns(NamedTuple):
    """Indices of columns."""

    time: int | None
    """The column of times, if there is one."""
    frame: int | None
    """The column that counts frames, if there is one."""
    channels: tuple[int, ...]
    """Those of numbers."""
    left_out: tuple[int, ...]
    """Those of something else."""
    likelihoods: Mapping[int, int]
    """From those of coordinates to the one that says how likely these are."""

    @property
    def telling_frames(self) -> list[int]:
        """Those of times and of frames that there are."""
        return [column for column in (self.time, self.frame) if column is not None]


def is_index(name: str) -> bool:
    """Return whether a column of this name has times or counts frames."""
    plain = name.strip().lower()
    return any(pattern.fullmatch(plain) for pattern in (_TIME, _FRAME)) or plain in _COUNT


def is_time(name: str) -> bool:
    """Return whether a column of this name has times."""
    return _TIME.fullmatch(name.strip().lower()) is not None


def is_likelihood(name: str) -> bool:
    """Return whether a column of this name says how likely something is."""
    return _LIKELIHOOD.fullmatch(name) is not None


def time_unit(name: str) -> str:
    """Return the unit that the name of a column of times states, by its first letter, or none."""
    found = _TIME.fullmatch(name.strip().lower())
    unit = (found[1] or "") if found else ""
    return "s" if unit.startswith("s") else unit[:1].replace("u", "μ").replace("µ", "μ")


def sort_columns(
    names: Sequence[str], is_number: Sequence[bool], left_alone: frozenset[int] = frozenset()
) -> TableColumns:
    """Return which columns are times, frames, likelihoods and channels.

    Parameters
    ----------
    names : sequence of str
        Such as ``time`` (also ``time [s]``, ``Time (Seconds)``, ``timestamp``, ``time_ms``); such
        as ``frame`` or ``frame_idx``, which counts the frames as a column without a name does; such
        as ``nose.likelihood`` beside ``nose.x``. Case does not matter.
    is_number : sequence of bool
        Whether a column has numbers; others are left out.
    left_alone : frozenset of int
        Columns of numbers that are no channels either.
    """
    plain = [name.strip().lower() for name in names]
    numbers = [k for k in range(len(names)) if is_number[k]]
    times = [k for k in numbers if _TIME.fullmatch(plain[k])]
    frames = [k for k in numbers if _FRAME.fullmatch(plain[k])]
    others = [k for k, name in enumerate(plain) if name in _COUNT or _QUALITY.fullmatch(name)]
    likelihoods, repeated = _match_likelihoods({k: names[k] for k in numbers})
    apart = {*times, *frames, *others, *left_alone, *likelihoods.values(), *repeated}
    channels = tuple(k for k in numbers if k not in apart)
    left_out = tuple(k for k in range(len(names)) if not is_number[k] and k not in apart)
    return TableColumns(_first(times), _first(frames), channels, left_out, likelihoods)


def _first(columns: Sequence[int]) -> int | None:
    return columns[0] if columns else None


def _match_likelihoods(names: Mapping[int, str]) -> tuple[dict[int, int], set[int]]:
    """Return the column of likelihoods for each coordinate of the same marker that has one.

    Where a marker has several, such as visibility and presence, the first counts; the others are
    returned, too.
    """
    sure: dict[str, list[int]] = {}
    for column, name in names.items():
        found = _LIKELIHOOD.fullmatch(name.strip())
        if found:
            sure.setdefault((found[1] or "") + (found[2] or found[3] or ""), []).append(column)
    coordinates = {k: _COORDINATE.fullmatch(name.strip()) for k, name in names.items()}
    stems = {k: (one[1] or "") + (one[2] or "") for k, one in coordinates.items() if one}
    matched = {column: sure[stem][0] for column, stem in stems.items() if stem in sure}
    return matched, {k for stem in {*stems.values()} for k in sure.get(stem, ())[1:]}


def split_unit(name: str) -> tuple[str, str]:
    """Return the name and the unit that a column's name states, such as ``knee.rx [deg]``."""
    name = name.strip()
    known = _IN_PARENTHESES.fullmatch(name)
    found = known or _IN_BRACKETS.fullmatch(name)
    if found is None:
        return name, ""
    unit = found[2].lower() if known else found[2].strip()
    return found[1], _SYNONYMS.get(unit.lower(), unit)


def warn_of_text(file: str, names: Sequence[str]) -> None:
    """Warn that some columns are left out, as they are not numbers."""
    if names:
        text = f"{file}: left out, as they are not numbers: {', '.join(names)}"
        warnings.warn(text, TextColumnsWarning, stacklevel=2)
