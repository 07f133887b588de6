from .archives import (
    advise_supply,
    archive_at,
    explain_fetching,
    fetch_command,
    recording_names,
    require_recordings,
)
from .catalogue.entries import (
    entrant_entry,
    format_entry,
    library_entry,
    metric_entry,
    model_entry,
    task_entry,
)
from .catalogue.listed import list_model, list_task
from .comparison.contrasts import compare
from .errors import ExitCode, UnknownNameError, UsageError
from .figures.alignment import draw_alignments
from .figures.blends import draw_blends
from .figures.coregionalisation import draw_coregionalisation
from .figures.covariances import draw_covariances
from .figures.filled_channels import draw_filled_channels
from .figures.gap_error import draw_gap_error
from .figures.latent_space import draw_latent_spaces
from .figures.longest_gaps import draw_longest_gaps
from .figures.motions.filled import draw_filled_motion
from .figures.motions.sampled import draw_sampled_motion
from .figures.solved import Solved
from .figures.trend import draw_trends
from .formats import format_for
from .gate.regression_check import check
from .inspection.explanation import explain
from .inspection.forecast import forecast_text, lacking, lacking_line, plan_table
from .inspection.left_out import left_out_lines
from .inspection.output import explanation_table, state_lines, state_table
from .inspection.recordings import data_totals, next_data_step
from .inspection.state import RunState, run_state
from .leaderboard.side_by_side import describe_entrants, unite_submissions
from .leaderboard.submission import read_models, read_submission, write_submission
from .merging.merge import merge
from .missing_values import choose_missing_rule
from .plugins import load_plugin, load_plugins
from .problems.base import InvalidPredictionError, Problem
from .problems.body import Body, JointAngles, JointPositions
from .problems.cluster import ClusterProblem, Clusters
from .problems.impute import ImputeProblem
from .problems.masks import hide_all_but, hide_frames, hide_runs
from .problems.recover import RecoverProblem
from .problems.synthesise import SynthesiseProblem
from .problems.unit import Unit
from .recording_checks.reading import Reading
from .registry import FORMATS, LIBRARIES, METRICS, MODELS, TASKS
from .results.bundle import bundle
from .results.drawn import last_drawn, mark_drawn, stamp
from .results.error_parts import error_parts
from .results.finished import describe_basis, finished_records
from .results.frames import job_table, score_table
from .results.illustrations import illustrations
from .results.named_results import find_cases, find_labels, find_metrics, find_tasks
from .results.solved_problems import solved_problem
from .runs.directory import RunDirectory
from .runs.execution.base import Backend
from .runs.execution.choice import open_backend, require_backend
from .runs.execution.this_machine import ThisMachine
from .runs.execution.worker_context import worker_context
from .runs.job import Job, WorkerConfig
from .runs.machine import memory_share, n_cores
from .runs.plan import plan, required_recordings
from .runs.plan_document import plan_document, planned_task_files
from .runs.provenance import provenance
from .runs.record import Record, Status
from .runs.request import Request, list_unmet_needs, split_cases
from .runs.run import run
from .task_files.building import add_tasks
from .task_files.checking import open_task_files
from .task_files.task_file import TaskFile, with_folders
from .task_files.template import draft
from .tasks.address import Address
from .tasks.base import Case, Entrant, Profile, Task
from .tasks.people import people_tasks
from .tasks.seeds import Seeds

__all__ = [
    "FORMATS",
    "LIBRARIES",
    "METRICS",
    "MODELS",
    "TASKS",
    "Address",
    "Backend",
    "Body",
    "Case",
    "ClusterProblem",
    "Clusters",
    "Entrant",
    "ExitCode",
    "ImputeProblem",
    "InvalidPredictionError",
    "Job",
    "JointAngles",
    "JointPositions",
    "Problem",
    "Profile",
    "Reading",
    "Record",
    "RecoverProblem",
    "Request",
    "RunDirectory",
    "RunState",
    "Seeds",
    "Solved",
    "Status",
    "SynthesiseProblem",
    "Task",
    "TaskFile",
    "ThisMachine",
    "Unit",
    "UnknownNameError",
    "UsageError",
    "WorkerConfig",
    "add_tasks",
    "advise_supply",
    "archive_at",
    "bundle",
    "check",
    "choose_missing_rule",
    "compare",
    "data_totals",
    "describe_basis",
    "describe_entrants",
    "draft",
    "draw_alignments",
    "draw_blends",
    "draw_coregionalisation",
    "draw_covariances",
    "draw_filled_channels",
    "draw_filled_motion",
    "draw_gap_error",
    "draw_latent_spaces",
    "draw_longest_gaps",
    "draw_sampled_motion",
    "draw_trends",
    "entrant_entry",
    "error_parts",
    "explain",
    "explain_fetching",
    "explanation_table",
    "fetch_command",
    "find_cases",
    "find_labels",
    "find_metrics",
    "find_tasks",
    "finished_records",
    "forecast_text",
    "format_entry",
    "format_for",
    "hide_all_but",
    "hide_frames",
    "hide_runs",
    "illustrations",
    "job_table",
    "lacking",
    "lacking_line",
    "last_drawn",
    "left_out_lines",
    "library_entry",
    "list_model",
    "list_task",
    "list_unmet_needs",
    "load_plugin",
    "load_plugins",
    "mark_drawn",
    "memory_share",
    "merge",
    "metric_entry",
    "model_entry",
    "n_cores",
    "next_data_step",
    "open_backend",
    "open_task_files",
    "people_tasks",
    "plan",
    "plan_document",
    "plan_table",
    "planned_task_files",
    "provenance",
    "read_models",
    "read_submission",
    "recording_names",
    "require_backend",
    "require_recordings",
    "required_recordings",
    "run",
    "run_state",
    "score_table",
    "solved_problem",
    "split_cases",
    "stamp",
    "state_lines",
    "state_table",
    "task_entry",
    "unite_submissions",
    "with_folders",
    "worker_context",
    "write_submission",
]
