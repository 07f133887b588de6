from .changes import run_changes
from .contrasts import compare, tidy
from .output import markdown, notes, terminal
from .sides import between_models, between_runs, side_names

__all__ = [
    "between_models",
    "between_runs",
    "compare",
    "markdown",
    "notes",
    "run_changes",
    "side_names",
    "terminal",
    "tidy",
]
