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
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile, ZipInfo

from msgspec import Meta

from mocapbench.basics.whole_files import atomic_write, write_bytes
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import words_of
from mocapbench.benchmark.foreign_files import (
    ForeignFileError,
    Name,
    encode_json,
    fit_schema,
    mapping_schema,
    read_json,
    read_toml,
    table_schema,
)
from mocapbench.benchmark.merging.reconcile import MergedRun, read_merged_run
from mocapbench.benchmark.runs.directory import RunDirectory

__all__ = ["read_models", "read_submission", "write_submission"]

_ABOUT, _PLAN = "about.json", "plan.json"
_MEMBER = re.compile(r"about\.json|plan\.json|records/[0-9a-f]{64}\.json")
_EARLIEST = (1980, 1, 1, 0, 0, 0)
"""The time of every file, so that the same records give the same bytes."""
_MOST_FILES, _MOST_BYTES = 500_000, 4 * 2**30
"""Of an archive, unpacked: tens of thousands of jobs take some hundred megabytes."""

_Address = Annotated[str, Meta(pattern=r"\Ahttps?://\S+\Z", max_length=2000)]
_MODEL = table_schema({}, optional={"paper": Name, "code": _Address, "licence": Name})
_MODELS = mapping_schema(_MODEL)
_DOCUMENT = table_schema(
    {"format": Literal[1], "by": Annotated[str, Meta(min_length=1, max_length=100)]},
    optional={"link": _Address, "models": _MODELS},
)
_NO_ARCHIVE = (BadZipFile, OSError, EOFError, RuntimeError, NotImplementedError, zlib.error)
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
    models: dict[str, Any] = read_toml(path, _MODELS)
    return models


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
        If the run has no record or tasks of the user's own, or a text is no address or too long.
    """
    plan, records = store.load_plan(), store.planned()
    if plan.get("task_files"):
        raise UsageError(
            "expected tasks that everybody has, got those of a file of your own, on recordings "
            "that nobody else can compare with; run without --task-file"
        )
    if not records:
        raise UsageError(f"{store.path} holds no record of its last run; run `mocapbench run`")
    about = {"format": 1, "by": by, "models": dict(models), **({"link": link} if link else {})}
    fit_schema(about, _DOCUMENT)
    files = {_ABOUT: encode_json(about), _PLAN: encode_json(plan)}
    files |= {f"records/{record.key}.json": record.to_json().encode() for record in records}
    with atomic_write(path) as file, ZipFile(file, "w", ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            archive.writestr(_describe_member(name), content)
    return len(records)


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
    try:
        store = RunDirectory.create(folder)
        for name, content in _list_members(path):
            _, _, record = name.rpartition("/")
            target = store.record_path(record[:-5]) if "/" in name else folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            write_bytes(target, content)
        about: dict[str, Any] = read_json(folder / _ABOUT, _DOCUMENT)
        store.load_plan()
        run = read_merged_run(folder)
    except ForeignFileError as error:
        raise _refuse(path, str(error)) from error
    except _NO_ARCHIVE as error:
        raise _refuse(
            path, words_of(error) if isinstance(error, OSError) else str(error)
        ) from error
    if run.store.damaged:
        raise _refuse(path, run.store.damaged[0])
    return about, run


def _list_members(path: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the name and the content of each file of an archive, which must all be expected."""
    with ZipFile(path) as archive:
        members = archive.infolist()
        others = [member.filename for member in members if not _MEMBER.fullmatch(member.filename)]
        size = sum(member.file_size for member in members)
        lacking = {_ABOUT, _PLAN} - {*archive.namelist()}
        if lacking:
            raise ForeignFileError(f"it has no {min(lacking)}")
        if others:
            raise ForeignFileError(f"expected {_ABOUT}, {_PLAN} and records, got {others[0]!r}")
        if len(members) > _MOST_FILES or size > _MOST_BYTES:
            raise ForeignFileError(
                f"expected at most {_MOST_FILES} files of {_MOST_BYTES >> 20} MiB together, got "
                f"{len(members)} of {size >> 20} MiB"
            )
        yield from ((member.filename, archive.read(member)) for member in members)


def _name_error(error: Exception) -> str:
    match error:
        case OSError():
            return words_of(error)
        case _:
            return f"it cannot be unpacked ({error})"


def _refuse(path: Path, got: str) -> ForeignFileError:
    return ForeignFileError(
        f"{path}: expected an archive that `mocapbench submit` wrote; {got}; ask who sent it to "
        "write it again"
    )
