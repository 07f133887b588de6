"""Which markers nobody has named: the tracks that programs leave over, by the names they give them.

Vicon writes ``*12``, Qualisys ``New 0001``, Motive ``Unlabeled 1200``, Motion Analysis ``U_3`` and
``Unnamed_58``, which BTK and Mokka write as ``*Unnamed_58``; others ``uname*3``. A marker without a
name is ``unlabelled`` here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

__all__ = ["find_unmeasured", "is_unlabelled", "list_measured"]

_WORDS = "unlabell?ed|unnamed|unidentified|unassigned|unknown|uname"
_STRAY = re.compile(
    rf"""(.*:)?  # the subject
    ( [*?]+\d*
    | [*]?({_WORDS})([\s_]?(marker|point|trajectory|track))?([\s_.:\#*(-]*\d+\)?)?
    | [*]?new[\s_]*\d+
    | [*]?u_\d+
    )
    (-\d+)?  # of several with one name
    [._:\s-][xyz]""",
    re.IGNORECASE | re.VERBOSE,
)


def is_unlabelled(channel: str) -> bool:
    """Return whether a channel is of a marker that nobody named.

    Examples
    --------
    >>> from mocapbench.datasets.formats.strays import is_unlabelled
    >>> list(map(is_unlabelled, ["*12.x", "Unlabeled 1200.y", "U_3.z", "unlabelled-2.x"]))
    [True, True, True, True]
    >>> list(map(is_unlabelled, ["LKNE.x", "*LKNE.x", "New.x", "U3.x"]))
    [False, False, False, False]
    """
    return _STRAY.fullmatch(channel) is not None


def find_unmeasured(channels: Iterable[str], results: Iterable[str]) -> set[str]:
    """Return the channels that are of no named marker or joint.

    Parameters
    ----------
    channels : iterable of str
    results : iterable of str
        Channels that are results of a model of the body, as the file's format says.
    """
    return {*filter(is_unlabelled, channels), *results}


def list_measured(channels: Iterable[str], results: Iterable[str]) -> list[str]:
    """Return the other channels, of named markers and joints, in their order."""
    channels = list(channels)
    unmeasured = find_unmeasured(channels, results)
    return [name for name in channels if name not in unmeasured]
