"""Lists of people: who is tested on which recordings, and what models may learn from.

A list is a table of tab-separated values. `PEOPLE` is that of thirty people of the CMU database,
chosen by a rule that looks at no result: of each subject the recordings with a registered digest
that last 70 frames or more at 30 frames per second, by number; the first, fifth and ninth of them
are tested on, and the first sixteen of all others are learnt from. What they show is what the
database's index says. The salsa of subjects 60 and 61, who dance together, is taken to have 60
frames per second: with 120, as all others, their feet would move at eight or nine metres a second.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from itertools import chain, zip_longest
from pathlib import Path

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.keys import split_key

__all__ = ["N_FOLDS", "RATE", "People", "generated_people", "read_people"]

RATE = 30
"""Frames per second of the tasks; the rate of every recording is a multiple of it."""
N_FOLDS = 3
"""Into how many groups people are split, so that nobody is tested by models that know them."""
N_OWN = 3

_COLUMNS = ("subject", "trial", "person", "rate", "role", "shows")
_ROLES = ("test", "train")
_N_WALKERS, _FIRST_WALKER, _N_WALKS = 30, 101, 8


class People:
    r"""People by subject, with recordings to be tested on and to learn from.

    Parameters
    ----------
    text : str
        Tab-separated values under the heads subject, trial, person, rate, role and shows. A person
        is named by a subject: subjects of the same person are never strangers to each other, and
        statistics count them once. The role is ``test`` or ``train``.
    file : str
        Its name, for messages.
    library : str
        The library that the recordings are of.

    Raises
    ------
    FormatError
        If it is no such table, a recording or a subject comes twice, a recording has both roles, or
        a rate is no multiple of 30; with the line.

    Examples
    --------
    >>> from mocapbench.datasets import People
    >>> heads = "subject\ttrial\tperson\trate\trole\tshows"
    >>> rows = ["02\t01\t02\t120\ttest\twalk", "02\t02\t02\t120\ttrain\twalk"]
    >>> people = People("\n".join([heads, *rows]))
    >>> people.tests("02"), people.own("02")
    (('cmu:02_01',), ('cmu:02_02',))
    """

    def __init__(self, text: str, file: str = "people.tsv", library: str = "cmu") -> None:
        self.file: str = file
        self.library: str = library
        self._rows: dict[str, Mapping[str, str]] = {}
        self._lines: dict[str, int] = {}
        self._by_subject: dict[str, list[str]] = {}
        table = csv.reader(text.splitlines(), delimiter="\t", quoting=csv.QUOTE_NONE)
        heads = next(table, [])
        if tuple(heads) != _COLUMNS:
            expected, got = f"the heads {', '.join(_COLUMNS)}", ", ".join(heads)
            raise self._fault(1, expected, got, "write them with tabs between")
        for line, cells in enumerate(table, start=2):
            if any(cells):
                self._add(line, cells)
        self._require_tests()
        self._require_persons()
        self._folds = self._split_persons()
        self._strangers = self._order_strangers()

    def _add(self, line: int, cells: list[str]) -> None:
        """Add a row, once it is known to be usable."""
        if len(cells) != len(_COLUMNS):
            raise self._fault(line, f"{len(_COLUMNS)} cells", len(cells), "put tabs between them")
        row = dict(zip(_COLUMNS, cells, strict=True))
        self._check_cells(line, row)
        uri = f"{self.library}:{row['subject']}_{row['trial']}"
        self._check_alone(line, uri, row)
        self._rows[uri], self._lines[uri] = row, line
        self._by_subject.setdefault(row["subject"], []).append(uri)

    def _check_cells(self, line: int, row: Mapping[str, str]) -> None:
        """Refuse a row that names no recording, or has no usable rate or role."""
        key, rate, role = f"{row['subject']}_{row['trial']}", row["rate"], row["role"]
        try:
            split_key(key)
        except ValueError as error:
            advice = "write a subject such as 02 and a trial such as 01"
            raise self._fault(line, "a subject and a trial", key, advice) from error
        if not rate.isdecimal() or int(rate) % RATE or not int(rate):
            advice = "resample the recording, or leave it out"
            raise self._fault(line, f"a rate that is a multiple of {RATE}", rate, advice)
        if role not in _ROLES:
            raise self._fault(line, f"the role {' or '.join(_ROLES)}", role, "correct it")

    def _check_alone(self, line: int, uri: str, row: Mapping[str, str]) -> None:
        """Refuse a recording that is here already, and a subject whose rows are apart."""
        subject = row["subject"]
        if uri in self._rows:
            first, role = self._lines[uri], self._rows[uri]["role"]
            what = "twice" if role == row["role"] else f"as {role} and as {row['role']}"
            expected, got = "every recording once", f"{uri} {what}, first on line {first}"
            raise self._fault(line, expected, got, "leave one of the rows out")
        lines = [self._lines[uri] for uri in self._of_subject(subject)]
        if lines and lines[-1] != line - 1:
            expected, got = "every subject once", f"{subject} again, after line {lines[-1]}"
            raise self._fault(line, expected, got, "put the rows of a subject together")
        persons = {self._rows[uri]["person"] for uri in self._of_subject(subject)}
        if persons - {row["person"]}:
            got = f"{persons.pop()} before and {row['person']} here"
            raise self._fault(line, f"one person for subject {subject}", got, "correct one of them")

    def _require_tests(self) -> None:
        if not self.subjects:
            raise FormatError(self.file, "recordings in the role test", "none", "name some")

    def _require_persons(self) -> None:
        """Refuse a person who is no subject of the list, as a misspelt one would be."""
        for uri, row in self._rows.items():
            if row["person"] not in self._by_subject:
                expected, got = "a subject of this list as the person", row["person"]
                advice = f"write {row['subject']}, or another subject who is the same person"
                raise self._fault(self._lines[uri], expected, got, advice)

    def _fault(self, line: int, expected: str, got: object, advice: str) -> FormatError:
        return FormatError(self.file, expected, str(got) or "nothing", advice, line)

    def fault(self, uri: str, expected: str, got: str, advice: str) -> FormatError:
        """Return the error of a recording, with the line on which it stands."""
        return self._fault(self._lines[uri], expected, f"{got} in {uri}", advice)

    def _of_subject(self, subject: str, *roles: str) -> tuple[str, ...]:
        """Return addresses of the recordings of a subject, those in some roles or all."""
        uris = self._by_subject.get(subject, ())
        return tuple(uri for uri in uris if not roles or self._rows[uri]["role"] in roles)

    @property
    def subjects(self) -> tuple[str, ...]:
        """The subjects that are tested, in the order of the list."""
        tested = (row["subject"] for row in self._rows.values() if row["role"] == "test")
        return tuple(dict.fromkeys(tested))

    @property
    def recordings(self) -> tuple[str, ...]:
        """Addresses of all recordings."""
        return tuple(self._rows)

    def person(self, subject: str) -> str:
        """Return which person a subject is."""
        return self._rows[self._of_subject(subject)[0]]["person"]

    def shows(self, uri: str) -> str:
        """Return what a recording shows, as the list has it."""
        return self._rows[uri]["shows"]

    def rate(self, uri: str) -> int:
        """Return how many frames per second a recording has."""
        return int(self._rows[uri]["rate"])

    def tests(self, subject: str) -> tuple[str, ...]:
        """Return addresses of the recordings that a subject is tested on."""
        return self._of_subject(subject, "test")

    def own(self, subject: str) -> tuple[str, ...]:
        """Return addresses of up to three other recordings of a subject, to learn from."""
        return self.others(subject)[:N_OWN]

    def others(self, subject: str) -> tuple[str, ...]:
        """Return addresses of all recordings of a subject that it is not tested on."""
        return self._of_subject(subject, "train")

    def fold(self, subject: str) -> int:
        """Return the group, 0 to 2, with whose people a subject is tested."""
        return self._folds[self.person(subject)]

    def _split_persons(self) -> Mapping[str, int]:
        """Return the group of each person, so that each leaves about two thirds to learn from.

        Those with the most recordings to learn from come first, each where there are fewest.
        """
        sizes = dict.fromkeys((row["person"] for row in self._rows.values()), 0)
        for row in self._rows.values():
            sizes[row["person"]] += row["role"] == "train"
        totals, folds = [(0, 0, fold) for fold in range(N_FOLDS)], {}
        for person in sorted(sizes, key=lambda person: -sizes[person]):
            recordings, people, fold = min(totals)
            folds[person] = fold
            totals[fold] = (recordings + sizes[person], people + 1, fold)
            totals.sort(key=lambda total: total[-1])
        return folds

    def strangers(self, subject: str, n: int) -> tuple[str, ...]:
        """Return addresses of ``n`` recordings of people who are not tested with a subject.

        First one of each person, then a second of each that has one, and so on, so that fewer are
        the beginning of more.
        """
        return self._strangers[self.fold(subject)][:n]

    def _order_strangers(self) -> Mapping[int, tuple[str, ...]]:
        """Return what may be learnt from by those who test each group."""
        of_persons: dict[str, list[str]] = {}
        for uri, row in self._rows.items():
            if row["role"] == "train":
                of_persons.setdefault(row["person"], []).append(uri)
        return {
            fold: _interleave(
                uris for person, uris in of_persons.items() if self._folds[person] != fold
            )
            for fold in range(N_FOLDS)
        }

    @property
    def most_strangers(self) -> int:
        """How many recordings of people who are not tested there are for every subject."""
        return min(len(self._strangers[self.fold(subject)]) for subject in self.subjects)


def _interleave(lists: Iterable[list[str]]) -> tuple[str, ...]:
    """Return the first of each list, then the second of each, and so on."""
    rounds = zip_longest(*lists)
    return tuple(uri for uri in chain.from_iterable(rounds) if uri is not None)


def read_people(path: str | Path | None = None) -> People:
    """Return the people that a table lists; by default thirty people of the CMU database.

    Parameters
    ----------
    path : str, Path or None
        See `People`.

    Raises
    ------
    FormatError
        If it is no such table, or there is none.
    """
    file = Path(path) if path else Path(__file__).with_name("people.tsv")
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        expected, got = "text in UTF-8", f"the byte {error.object[error.start]:#04x}"
        raise FormatError(file.name, expected, got, "save it as UTF-8") from error
    except OSError as error:
        expected, got = "a list of people", str(error.strerror)
        raise FormatError(str(file), expected, got, "give the path of a file") from error
    return People(text, file.name)


def generated_people() -> People:
    """Return thirty generated walkers with bodies of their own, each tested in one style.

    The style of the test recording goes through those of `gait_style`, one walker after the other.
    """
    rows = ["\t".join(_COLUMNS)]
    for walker in range(_N_WALKERS):
        subject, tested = str(_FIRST_WALKER + walker), walker % 5 + 1
        for trial in range(1, _N_WALKS + 1):
            role = "test" if trial == tested else "train"
            rows.append(f"{subject}\t{trial:02}\t{subject}\t120\t{role}\tgenerated gait")
    return People("\n".join(rows), "generated people", "gait")
