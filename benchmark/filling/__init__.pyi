from .choosing.choice import EFFORTS
from .filled_recording import fill, require_fillable
from .gap_table import tabulate_gaps
from .input_files import InputFile, read_input_files
from .output_files import (
    OutputPaths,
    name_output_files,
    require_writable,
    reserve_outputs,
    write,
)
from .page import compose_page
from .requests.names import split_names
from .requests.refusals import NothingToFillError
from .requests.request import NamedEntries
from .workers import Workers

__all__ = [
    "EFFORTS",
    "InputFile",
    "NamedEntries",
    "NothingToFillError",
    "OutputPaths",
    "Workers",
    "compose_page",
    "fill",
    "name_output_files",
    "read_input_files",
    "require_fillable",
    "require_writable",
    "reserve_outputs",
    "split_names",
    "tabulate_gaps",
    "write",
]
