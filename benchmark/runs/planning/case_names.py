"""Finding cases by what a user types: a name, a pattern, or how a name begins."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase

__all__ = ["matching_cases", "split_cases"]


def matching_cases(wanted: str, names: Iterable[str]) -> tuple[str, ...]:
    """Return the names that ``wanted`` stands for; none if it stands for none.

    They are the first of these that there are: the name itself; the names that match a pattern
    such as ``observed*``; the names that begin with it. An underscore stands for a hyphen too, so
    that ``35_03``, as CMU writes it, finds the cases on that recording.

    Parameters
    ----------
    wanted : str
    names : iterable of str
        Every name there is.

    Examples
    --------
    >>> names = ("35-03 four-walkers", "35-03 three-walkers", "test 1", "test 10")
    >>> matching_cases("35_03", names)
    ('35-03 four-walkers', '35-03 three-walkers')
    >>> matching_cases("test 1", names)
    ('test 1',)
    """
    names, typed = tuple(dict.fromkeys(names)), _hyphenate(wanted)
    ways = (
        [name for name in names if _hyphenate(name) == typed],
        [name for name in names if fnmatchcase(_hyphenate(name), typed)],
        [name for name in names if _hyphenate(name).startswith(typed)],
    )
    return tuple(next(filter(None, ways), ()))


def split_cases(text: str, names: Iterable[str]) -> Iterator[str]:
    """Yield what a user typed at commas, those apart that belong to the name of a case.

    Parameters
    ----------
    text : str
    names : iterable of str
        Every name there is.

    Examples
    --------
    >>> names = ("a limb 1 s, alone", "test 1")
    >>> list(split_cases("test 1, a limb 1 s, alone", names))
    ['test 1', 'a limb 1 s, alone']
    """
    known, parts = tuple(names), [part.strip() for part in text.split(",") if part.strip()]
    while parts:
        lengths = [
            n for n in range(len(parts), 1, -1) if matching_cases(", ".join(parts[:n]), known)
        ]
        n = next(iter(lengths), 1)
        yield ", ".join(parts[:n])
        parts = parts[n:]


def _hyphenate(name: str) -> str:
    return name.replace("_", "-")
