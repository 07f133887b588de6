from .description import (
    TITLES,
    describe_check,
    describe_frames,
    describe_size,
    describe_together,
    group_findings,
)
from .file_check import check_file, list_faults
from .hidden_spikes import tell_spikes

__all__ = [
    "TITLES",
    "check_file",
    "describe_check",
    "describe_frames",
    "describe_size",
    "describe_together",
    "group_findings",
    "list_faults",
    "tell_spikes",
]
