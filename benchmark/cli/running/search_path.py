"""Where Python looks for modules: not in the current folder, unless somebody names it."""

from __future__ import annotations

import os
import sys
from pathlib import Path

__all__ = ["forget_empty_entries"]

_VARIABLE = "PYTHONPATH"


def forget_empty_entries() -> None:
    """Take from the search path what empty entries of PYTHONPATH put there: the current folder.

    ``PYTHONPATH=/mine:$PYTHONPATH`` ends with an empty entry where nothing was set before. Python
    takes such an entry for the current folder, which may be one that somebody sent. This process
    and those that it starts then look there no longer; modules loaded before are as they are.
    """
    entries = os.environ.get(_VARIABLE, "").split(os.pathsep)
    named = [entry for entry in entries if entry]
    here = Path.cwd()
    if len(entries) == 1 or named == entries or here in map(Path.absolute, map(Path, named)):
        return
    os.environ[_VARIABLE] = os.pathsep.join(named)
    first = 0 if sys.flags.safe_path else 1  # before it is the folder of the script that runs
    sys.path[first:] = [entry for entry in sys.path[first:] if Path(entry) != here]
