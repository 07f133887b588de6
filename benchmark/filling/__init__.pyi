from .candidates import require_candidate
from .choosing.choice import require_room
from .filled_file import BEST, FilledFile, fill
from .input_files import InputFile, read_input_files
from .messages import describe_choice, describe_fill, list_remarks
from .output_files import OutputPaths, name_output_files, require_writable, write
from .page import compose_page
from .reading import Reading
from .requests.refusals import NothingToFillError
from .requests.request import NamedEntries
from .workers import Workers

__all__ = [
    "BEST",
    "FilledFile",
    "InputFile",
    "NamedEntries",
    "NothingToFillError",
    "OutputPaths",
    "Reading",
    "Workers",
    "compose_page",
    "describe_choice",
    "describe_fill",
    "fill",
    "list_remarks",
    "name_output_files",
    "read_input_files",
    "require_candidate",
    "require_room",
    "require_writable",
    "write",
]
