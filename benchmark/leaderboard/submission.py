"""A submission: the records of a run in one small archive, without recordings or predictions.

::

    submission.zip
        about.json              who ran it, and of each model the paper, the code and the licence
        plan.json               the jobs of the run
        records/<score key>.json

An archive of others is data: every file in it is read by a schema, and nothing is unpickled.
"""

from __future__ import annotations

import re
import tomllib
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

from msgspec import Meta

from mocapbench.basics.whole_files import atomic_write, write_bytes
from mocapbench.basics.words import printable
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.foreign_files import (
    ForeignFileError,
    Name,
    encode_json,
    mapping_schema,
    read_file,
    read_json,
    read_toml,
    table_schema,
)
from mocapbench.benchmark.merging.reconcile import MergedRun, read_merged_run
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record

__all__ = ["read_models", "read_submission", "write_submission"]

_ABOUT, _PLAN = "about.json", "plan.json"
_MEMBER = re.compile(r"about\.json|plan\.json|records/[0-9a-f]{64}\.json")
_EARLIEST = (1980, 1, 1, 0, 0, 0)
"""The time of every file, so that the same records give the same bytes."""
_MOST_FILES, _MOST_BYTES, _LARGEST = 500_000, 2**30, 2**26
"""Of an archive, its bytes unpacked, and those of a file: a plan of 100,000 jobs takes a third."""
_LONGEST = 100
"""Letters of the name of who sent it."""
_METHODS = {ZIP_STORED, ZIP_DEFLATED}

_ADDRESS = re.compile(r"https?://[!-~]{1,2000}")
_MODEL = ("paper", "code", "licence")
_MODELS = mapping_schema(mapping_schema(Name))
_DOCUMENT = table_schema(
    {"format": Literal[1], "by": Annotated[str, Meta(min_length=1)]},
    optional={"link": Name, "models": _MODELS},
)
_NO_ARCHIVE = (BadZipFile, OSError, EOFError, RuntimeError, ValueError, zlib.error)
"""What `zipfile` raises of damaged archives, of those with a password, and of other methods."""


def read_models(path: Path | None) -> dict[str, Any]:
    """Return what a TOML file says of models, by label: ``paper``, ``code`` and ``licence``.

    Raises
    ------
    ForeignFileError
        If it says anything else.
    """
    if path is None:
        return {}
    what, advice = "a table [LABEL] for each model", "see `mocapbench submit --help`"
    return read_file(path, what, advice, _read_whole_models)


def _read_whole_models(path: Path) -> dict[str, Any]:
    try:
        models: dict[str, Any] = read_toml(path, _MODELS)
    except tomllib.TOMLDecodeError as error:
        raise ForeignFileError(f"got {error}") from error
    _require_about(models, None)
    return models


def _require_about(models: Mapping[str, Mapping[str, str]], link: str | None) -> None:
    """Refuse what says of a model anything but what it should, and what is no address."""
    for label, said in models.items():
        if others := [name for name in said if name not in _MODEL]:
            known = ", ".join(_MODEL)
            raise ForeignFileError(f"expected of {label} any of {known}, got {others[0]}")
    addresses = {
        f"code of {label}": said["code"] for label, said in models.items() if "code" in said
    }
    for what, address in {**addresses, **({"link": link} if link else {})}.items():
        if not _ADDRESS.fullmatch(address):
            raise ForeignFileError(
                f"expected as {what} an address that begins with https:// or http://, got "
                f"{address!r}"
            )


def write_submission(
    store: RunDirectory, path: Path, by: str, link: str | None, models: Mapping[str, Any]
) -> int:
    """Write the records of a run and its plan to a new archive, and return how many they are.

    Parameters
    ----------
    store : RunDirectory
    path : Path
        Of the archive.
    by, link : str, str or None
        Who ran it, and the address of a page about them.
    models : mapping
        See `read_models`.

    Raises
    ------
    UsageError
        If the run has no record or tasks that others lack, or something is said of a model that it
        lacks.
    """
    _require_sender(by)
    plan, records = store.load_plan(), store.planned()
    if not records:
        raise UsageError(f"{store.path} holds no record of its last run; run `mocapbench run`")
    _require_shared_tasks(plan, records)
    known = {name for record in records for name in (record.address.label, record.model)}
    for label in models:
        if label not in known:
            raise UnknownNameError("model", label, sorted(known))
    _require_about(models, link)
    about = {"format": 1, "by": by, "models": dict(models), **({"link": link} if link else {})}
    files = {_ABOUT: encode_json(about), _PLAN: encode_json(plan)}
    files |= {f"records/{record.key}.json": record.to_json().encode() for record in records}
    with atomic_write(path) as file, ZipFile(file, "w", ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            archive.writestr(_describe_member(name), content)
    return len(records)


def _require_shared_tasks(plan: Mapping[str, Any], records: Sequence[Record]) -> None:
    """Refuse tasks that not everybody has."""
    own = [r.address.task for r in records if not TASKS.is_ours(r.address.task)]
    if plan.get("task_files") or own:
        raise UsageError(
            f"expected tasks that mocapbench brings along, got {own[0] if own else 'a task file'}, "
            "with which nobody else can compare; run without --task-file and --plugin"
        )


def _describe_member(name: str) -> ZipInfo:
    member = ZipInfo(name, _EARLIEST)
    member.compress_type, member.external_attr = ZIP_DEFLATED, 0o644 << 16
    return member


def read_submission(path: Path, folder: Path) -> tuple[dict[str, Any], MergedRun]:
    """Return who sent an archive and of what models, and the run that is in it.

    Parameters
    ----------
    path : Path
    folder : Path
        A new one, into which it is unpacked.

    Raises
    ------
    ForeignFileError
        If it is no whole submission.
    """
    if not path.is_file():
        raise ForeignFileError(f"expected an archive of `mocapbench submit`, got no file {path}")
    try:
        store = RunDirectory.create(folder)
        for name, content in _list_members(path):
            _, _, record = name.rpartition("/")
            target = store.record_path(record[:-5]) if "/" in name else folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            write_bytes(target, content)
        about: dict[str, Any] = read_json(folder / _ABOUT, _DOCUMENT)
        _require_about(about.get("models", {}), about.get("link"))
        _require_sender(about["by"])
        store.planned()
        run = read_merged_run(folder)
    except ForeignFileError as error:
        raise _refuse(path, str(error), folder) from error
    except _NO_ARCHIVE as error:
        raise _refuse(path, f"it cannot be unpacked ({error})", folder) from error
    if damaged := [*store.damaged, *run.store.damaged]:
        raise _refuse(path, damaged[0], folder)
    return about, run


def _require_sender(by: str) -> None:
    if len(by) > _LONGEST or by != printable(by).strip():
        raise ForeignFileError(
            f"expected a sender in plain text of at most {_LONGEST} letters, got {by!r}"
        )


def _list_members(path: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the name and the content of each file of an archive, which must all be expected."""
    with ZipFile(path) as archive:
        members = archive.infolist()
        _require_members(members)
        yield from ((member.filename, archive.read(member)) for member in members)


def _require_members(members: Sequence[ZipInfo]) -> None:
    """Refuse files of other names, sizes and methods, before any is unpacked."""
    names = Counter(member.filename for member in members)
    size = sum(member.file_size for member in members)
    largest = max((member.file_size for member in members), default=0)
    if others := [name for name in names if not _MEMBER.fullmatch(name)]:
        raise ForeignFileError(f"expected {_ABOUT}, {_PLAN} and records, got {others[0]!r}")
    if lacking := {_ABOUT, _PLAN} - names.keys():
        raise ForeignFileError(f"it has no {min(lacking)}")
    if names.total() > len(names):
        raise ForeignFileError(f"it has two files called {names.most_common(1)[0][0]}")
    if len(members) > _MOST_FILES or size > _MOST_BYTES or largest > _LARGEST:
        raise ForeignFileError(
            f"expected at most {_MOST_FILES} files of {_MOST_BYTES >> 20} MiB together and "
            f"{_LARGEST >> 20} MiB each, got {len(members)} of {size >> 20} and {largest >> 20} MiB"
        )
    if any(member.compress_type not in _METHODS for member in members):
        raise ForeignFileError("it is compressed by another method than deflate")


def _refuse(path: Path, got: str, folder: Path) -> ForeignFileError:
    said = got.replace(f"{folder}/", "")
    return ForeignFileError(
        f"{path}: expected an archive that `mocapbench submit` wrote; {said}; ask who sent it to "
        "write it again"
    )
