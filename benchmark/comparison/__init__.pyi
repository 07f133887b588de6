from .changes import run_changes
from .contrasts import compare
from .printing import markdown, notes, outcome, terminal
from .sides import between_models, between_runs, planned_side, side_names
from .tidy_table import tidy

__all__ = [
    "between_models",
    "between_runs",
    "compare",
    "markdown",
    "notes",
    "outcome",
    "planned_side",
    "run_changes",
    "side_names",
    "terminal",
    "tidy",
]
