from .choosing.choice import EFFORTS
from .faults import describe_faults
from .filled_recording import FilledRecording, fill, require_fillable
from .gap_table import describe_gaps, describe_options, sort_by_caution, tabulate_gaps
from .input_files import InputFile, read_input_files
from .messages import describe_choice, describe_fill, list_remarks
from .output_files import OutputPaths, name_output_files, require_writable, write
from .page import compose_page
from .requests.names import split_names
from .requests.refusals import NothingToFillError
from .requests.request import NamedEntries
from .workers import Workers

__all__ = [
    "EFFORTS",
    "FilledRecording",
    "InputFile",
    "NamedEntries",
    "NothingToFillError",
    "OutputPaths",
    "Workers",
    "compose_page",
    "describe_choice",
    "describe_faults",
    "describe_fill",
    "describe_gaps",
    "describe_options",
    "fill",
    "list_remarks",
    "name_output_files",
    "read_input_files",
    "require_fillable",
    "require_writable",
    "sort_by_caution",
    "split_names",
    "tabulate_gaps",
    "write",
]
