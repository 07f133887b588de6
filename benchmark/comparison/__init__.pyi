from .changes import run_changes
from .contrasts import compare
from .power import list_spreads, plan_people, read_numbers, require_plan
from .power_table import power_notes, power_tables
from .printing import markdown, notes, outcome, terminal
from .sides import between_models, between_runs, planned_side, side_names
from .tidy_table import tidy

__all__ = [
    "between_models",
    "between_runs",
    "compare",
    "list_spreads",
    "markdown",
    "notes",
    "outcome",
    "plan_people",
    "planned_side",
    "power_notes",
    "power_tables",
    "read_numbers",
    "require_plan",
    "run_changes",
    "side_names",
    "terminal",
    "tidy",
]
