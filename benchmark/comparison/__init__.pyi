from .contrasts import compare, tidy
from .output import markdown, notes, terminal
from .sides import between_models, between_runs

__all__ = [
    "between_models",
    "between_runs",
    "compare",
    "markdown",
    "notes",
    "terminal",
    "tidy",
]
