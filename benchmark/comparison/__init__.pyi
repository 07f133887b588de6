from .contrasts import between_models, between_runs, compare, tidy
from .output import markdown, notes, terminal

__all__ = [
    "between_models",
    "between_runs",
    "compare",
    "markdown",
    "notes",
    "terminal",
    "tidy",
]
