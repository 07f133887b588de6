"""The first task file of a folder: TOML with comments, which runs as it stands."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from glob import escape
from pathlib import Path, PurePosixPath
from string import Template
from textwrap import wrap

import tomli_w

from mocapbench.benchmark.registry import MODELS, build_unfitted
from mocapbench.benchmark.task_files.building import build_task
from mocapbench.benchmark.task_files.checking import check_document, require_folder
from mocapbench.benchmark.task_files.document import Document, TaskFileError
from mocapbench.benchmark.task_files.grouping import largest_group

__all__ = ["draft"]

_QUICK = (
    *("hold", "linear", "pchip", "makima", "cubic-spline"),
    *(
        "rigid-body",
        "marker-kriging",
        "pca-regression",
        "low-rank",
        "knn",
        "nn",
        "pose-kriging",
        "lds",
    ),
)
"""Models that take seconds rather than minutes on a recording of a minute."""

_HIDE = (
    'runs = { seconds = [0.1, 0.5, 1.0], count = 3, together = "joint" }',
    'runs = { seconds = [0.1, 0.25], count = 2, together = "joint" }',
    'runs = { seconds = 0.1, count = 1, together = "joint" }',
    "fraction = 0.2",
)
"""What to hide; the first that the recordings have room for."""


_FILE = Template("""\
# A benchmark of recordings of your own. Lines that begin with # do nothing: remove
# the sign from those that you want. docs/own-recordings.md explains every key.

title = "Gaps in our recordings"
description = "Gaps at random places of each recording, which models fill."

# The recordings to fill, one after the other: names or patterns, * for any text.
$files\

# What models learn from besides what is visible of it: the "others" of these files,
# "none", or patterns such as ["training/*.csv"].
$training\

${rate}\
# The part that counts, of every recording; all of it if these are left out.
# frames = "0:1200"                   # counted from 0, the last one not included
# channels = ["lknee.*", "rknee.*"]   # regular expressions of whole names

# How often gaps are drawn anew for every recording.
folds = $folds

${models}\
# Tables of the report, the first for its headlines; see `mocapbench list metrics`.
metrics = ["mse", "smse", "crps", "coverage_95"]

[hide]
# One of these ways. First, gaps of given lengths, `count` of each at random places;
# together = "all" channels, those of one "joint" or marker, or one "channel".
$hide
# fraction = 0.2                      # of the entries, each by itself
# frames = ["120:180"]                # the same in every fold, so folds = 1
# pattern-of = "with-gaps.csv"        # the gaps of another file of the folder

# Only in these channels; alone, without any of the ways above, from end to end.
# channels = ["lknee.*"]
""")

_RATE = Template("""\
# Frames per second, in place of what files say.
$rate
""")

_MODELS = Template("""\
# Leave this out for every model that can fill such gaps. Besides these:
${slower}\
$models
""")


def draft(
    file: str, folder: Path, rate: float | None
) -> tuple[str, tuple[str, ...], tuple[str, ...]]:
    """Return a task file for the most recordings of a folder that are alike.

    Parameters
    ----------
    file : str
        The file's name, for messages.
    folder : Path
    rate : float or None
        Frames per second, in place of what the files say.

    Returns
    -------
    text : str
        TOML that runs.
    tests : tuple of str
        Paths of the recordings that it names.
    left_out : tuple of str
        Why other files are not among them.

    Raises
    ------
    UsageError
        If no recording there can be used.
    """
    require_folder(folder)
    tests, left_out = largest_group(folder, rate)
    write = partial(_write_text, tests, _patterns(tests, left_out), rate)
    for hide in _HIDE:
        try:
            task_file = check_document(Document(file, write(hide, ())), folder)
        except TaskFileError as error:
            failure = error
            continue
        task = build_task(task_file)
        able = [name for name in MODELS.names() if task.accepts(build_unfitted(name))]
        return write(hide, able), tests, left_out
    raise failure


def _patterns(tests: tuple[str, ...], left_out: tuple[str, ...]) -> list[str]:
    """Return patterns of the files, or all their names if a pattern would find others too."""
    suffixes = {PurePosixPath(path).suffix for path in tests}
    if left_out or len(suffixes) > 1 or len(tests) == 1:
        return [escape(path) for path in tests]
    below = "**/" if any("/" in path for path in tests) else ""
    return [f"{below}*{suffixes.pop()}"]


def _write_text(
    tests: Sequence[str], patterns: list[str], rate: float | None, hide: str, able: Sequence[str]
) -> str:
    """Return a draft that hides so, for these models, or for all if none is named."""
    return _FILE.substitute(
        files=_setting("files", patterns),
        training=_setting("training", "others" if len(tests) > 1 else "none"),
        rate="" if rate is None else _RATE.substitute(rate=_setting("rate", rate)),
        folds=max(1, min(5, 20 // len(tests))),
        models=_models(able) if able else "",
        hide=hide,
    )


def _models(able: Sequence[str]) -> str:
    """Return the models that are quick or a user's own, and the others in a remark."""
    own = [name for name in able if not MODELS.is_installed(name)]
    named = [name for name in _QUICK if name in able] + own
    slower = ", ".join(name for name in able if name not in named)
    return _MODELS.substitute(
        slower="".join(f"# {line}\n" for line in wrap(slower, 96, break_on_hyphens=False)),
        models=_setting("models", named),
    )


def _setting(key: str, value: str | float | list[str]) -> str:
    """Return a line or more of TOML that give a key its value, whatever a text has in it."""
    return tomli_w.dumps({key: value})
