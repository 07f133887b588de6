"""Files of others, read by a schema: what does not fit it is told in one message.

Run directories, task files, tolerances and reference values come from anybody. A schema is a type:
it says which entries a file has, of what kind, how long a text may be and how large a number. All
files of JSON, TOML and CSV that a command is pointed at are read here, so that whatever they hold
ends in a `ForeignFileError`, which says where, what was expected, what was got, and what to do.
"""

from __future__ import annotations

import csv
import re
import stat
import sys
import tomllib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, NotRequired, TypedDict, TypeVar

import msgspec
from msgspec import Meta

from mocapbench.basics.words import encodable
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import shorten_text

__all__ = [
    "Count",
    "Finite",
    "ForeignFileError",
    "Index",
    "Key",
    "KeyOrNone",
    "Name",
    "Parameter",
    "Text",
    "decode_json",
    "decode_rows",
    "decode_toml",
    "encode_json",
    "fit_schema",
    "list_schema",
    "mapping_schema",
    "read_bytes",
    "read_file",
    "read_json",
    "read_text",
    "read_toml",
    "table_schema",
]

T = TypeVar("T")

Name = Annotated[str, Meta(max_length=10_000)]
"""Of a task, a case, an entrant, a file or a metric."""
Text = Annotated[str, Meta(max_length=1_000_000)]
"""A message, a traceback, or what a task file says."""
_FILE_NAME = r"[!#-)+,\-0-9;=@-\[\]-{}~][ !#-)+-.0-9;=@-\[\]-{}~]{0,99}"
"""Of ASCII without what Windows takes in no name of a file, and no dot at its beginning."""
Key = Annotated[str, Meta(pattern=rf"\A{_FILE_NAME}\Z")]
"""What names a file of a run directory; never a path that leads out of it."""
Index = Annotated[int, Meta(ge=0, le=10_000_000)]
Count = Annotated[int, Meta(ge=1, le=10_000_000)]
KeyOrNone = Annotated[str, Meta(pattern=rf"\A({_FILE_NAME})?\Z")]
"""A key, or an empty text where there is none."""
Finite = Annotated[float, Meta(ge=-sys.float_info.max, le=sys.float_info.max)]
_Scalar = None | bool | int | float | Name
_Nested = _Scalar | list[_Scalar] | dict[Name, _Scalar]
Parameter = _Scalar | list[_Nested] | dict[Name, _Nested]
"""The value of a parameter of a model, nested no deeper than models have them."""

_LARGEST = 64 * 2**20
"""Bytes of a file, unless more are expected."""
_SHOWN = 200
"""Characters of a row in a message."""
_PLAIN = {
    "int": "a whole number",
    "float": "a number",
    "str": "text",
    "bool": "true or false",
    "null": "null",
    "array": "a list",
    "object": "a table",
}
_TYPES = re.compile(r"`([a-z |]+)`")
_PATTERN = re.compile("matching regex '.*'")


class ForeignFileError(UsageError):
    """A file that does not hold what it should; the message says where, and what to do."""


def table_schema(entries: Mapping[str, Any], optional: Mapping[str, Any] | None = None) -> Any:
    """Return the schema of a table: a dictionary that has entries, and may have others.

    Parameters
    ----------
    entries, optional : mapping of str to type
        The schema of each entry that there must be, and that there may be.
    """
    others = {name: NotRequired[schema] for name, schema in (optional or {}).items()}
    return TypedDict("table", {**entries, **others})  # type: ignore[operator]


def list_schema(schema: Any) -> Any:
    """Return the schema of a list whose values all have one schema."""
    return list[schema]


def mapping_schema(schema: Any) -> Any:
    """Return the schema of a table of any names whose values all have one schema."""
    return dict[Name, schema]


def read_file(path: Path, what: str, advice: str, read: Callable[[Path], T]) -> T:
    """Return what ``read`` reads of a file, of which errors have the name.

    Parameters
    ----------
    path : Path
    what, advice : str
        What it should hold, such as ``"a plan"``, and what to do if it holds something else.
    read : callable
        Which may raise `ForeignFileError`, as the functions below do.

    Raises
    ------
    ForeignFileError
        That begins with the file, and ends with the advice.
    """
    try:
        return read(path)
    except ForeignFileError as error:
        raise ForeignFileError(f"{path}: expected {what}; {error}; {advice}") from error


def read_json(path: Path, schema: Any, most: int = _LARGEST) -> Any:
    """Return what a JSON file says.

    Parameters
    ----------
    path : Path
    schema : type
        What it should hold.
    most : int
        Bytes that it may have.

    Raises
    ------
    ForeignFileError
        If it cannot be read, is larger, or does not fit the schema.
    """
    return decode_json(read_bytes(path, most), schema)


def read_toml(path: Path, schema: Any) -> Any:
    """Return what a TOML file says; see `read_json`."""
    return decode_toml(read_text(path), schema)


def read_text(path: Path, most: int = _LARGEST) -> str:
    """Return the text of a file in UTF-8; see `read_bytes`."""
    try:
        return read_bytes(path, most).decode("utf-8")
    except UnicodeDecodeError as error:
        raise ForeignFileError(f"expected text in UTF-8, got {error.reason}") from error


def read_bytes(path: Path, most: int = _LARGEST) -> bytes:
    """Return what a file holds.

    Raises
    ------
    ForeignFileError
        If it is no file, as a folder and a pipe are none, or has more than ``most`` bytes.
    """
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            raise ForeignFileError("expected a file, got something else of this name")
        with path.open("rb") as file:
            content = file.read(most + 1) if status.st_size <= most else b""
    except OSError as error:
        raise ForeignFileError(f"it cannot be read ({error.strerror})") from error
    size = max(status.st_size, len(content))
    if size > most:
        raise ForeignFileError(f"expected at most {most >> 20} MiB, got {size >> 20} MiB")
    return content


def decode_json(data: bytes | str, schema: Any) -> Any:
    """Return what a JSON text says.

    Raises
    ------
    ForeignFileError
        If it does not fit the schema.
    """
    return _tell_schema(lambda: msgspec.json.decode(data, type=schema))


def encode_json(value: Any) -> bytes:
    """Return a document as JSON that `decode_json` reads; NaN becomes null.

    Parameters
    ----------
    value : object
        Of values that JSON has, and records of them.
    """
    try:
        return msgspec.json.encode(value, enc_hook=_encode_number)
    except (TypeError, UnicodeEncodeError):  # lone surrogates, keys that are not text
        plain = msgspec.to_builtins(value, enc_hook=_encode_number)
        return msgspec.json.encode(_escape_texts(plain))


def _encode_number(value: Any) -> float:
    """Return the number that NumPy's is."""
    match value:
        case float():
            return float(value)
        case _:
            raise TypeError(f"expected what JSON can hold, got {type(value).__name__}")


def _escape_texts(value: Any) -> Any:
    match value:
        case dict():
            return {encodable(str(key)): _escape_texts(item) for key, item in value.items()}
        case list() | tuple():
            return [_escape_texts(item) for item in value]
        case str():
            return encodable(value)
        case _:
            return value


def decode_toml(text: str, schema: Any) -> Any:
    """Return what a TOML text says; see `decode_json`."""
    return _tell_schema(lambda: msgspec.convert(_parse_toml(text), schema))


def _parse_toml(text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:  # which Python says of its own limit
        raise ForeignFileError("a number of too many digits") from error


def decode_rows(lines: Iterable[str]) -> list[dict[str, str]]:
    """Return the rows of a CSV text with a head: texts, which are yet to fit a schema.

    Raises
    ------
    ForeignFileError
        If a row has more or fewer cells than the head, or is no CSV.
    """
    try:
        rows = list(csv.DictReader(lines, strict=True))
    except csv.Error as error:
        raise ForeignFileError(f"expected CSV, got: {error}") from error
    for row in rows:
        if None in row or None in row.values():
            got = shorten_text(str([*row.values()]), _SHOWN)
            raise ForeignFileError(f"expected as many cells in a row as in the head, got {got}")
    return rows


def fit_schema(value: Any, schema: Any, *, strict: bool = True) -> Any:
    """Return a value of a document, which must fit a schema; see `decode_json`.

    Parameters
    ----------
    value : object
    schema : type
    strict : bool
        Whether a text is no number: in the cells of CSV, all is text.
    """
    return _tell_schema(lambda: msgspec.convert(value, schema, strict=strict, str_keys=not strict))


def _tell_schema(decode: Callable[[], T]) -> T:
    try:
        return decode()
    except RecursionError as error:
        raise ForeignFileError("too many lists in one another") from error
    except ForeignFileError:
        raise
    except (ValueError, msgspec.MsgspecError) as error:  # the latter is the former since 0.20
        raise ForeignFileError(_in_words(str(error))) from error


def _in_words(message: str) -> str:
    """Return the message of a schema in plain words, which begins with where in the file it is."""
    what, _, where = message.partition(" - at `")
    missing = re.fullmatch(r"Object missing required field `(.*)`", what)
    unknown = re.fullmatch(r"Object contains unknown field `(.*)`", what)
    if missing:
        what = f"expected the entry {missing[1]}, got none"
    elif unknown:
        what = f"expected no entry {unknown[1]}, got one"
    words = _PATTERN.sub("that names a file", _TYPES.sub(_name_types, what))
    place = f"at {re.sub(r'`|[$][.]?', '', where)}, " if where else ""
    return f"{place}{words[:1].lower()}{words[1:]}"


def _name_types(found: re.Match[str]) -> str:
    """Return the kinds of values that a schema names, such as ``int | null``, in plain words."""
    return " or ".join(_PLAIN.get(kind, kind) for kind in found[1].split(" | "))
