from .documents import junit, markdown, plain, summary, terminal
from .findings import Check, Finding
from .negative_control import check_controls
from .reference import Reference, of_records
from .reference_files import read_reference, write_reference
from .regression_check import check, differences, update_values
from .rule import Judgement, Tolerance, Verdict, judge
from .tolerances import read_tolerances
from .updating import require_updatable

__all__ = [
    "Check",
    "Finding",
    "Judgement",
    "Reference",
    "Tolerance",
    "Verdict",
    "check",
    "check_controls",
    "differences",
    "judge",
    "junit",
    "markdown",
    "of_records",
    "plain",
    "read_reference",
    "read_tolerances",
    "require_updatable",
    "summary",
    "terminal",
    "update_values",
    "write_reference",
]
