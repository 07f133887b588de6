from . import baselines, basics, benchmark, datasets, figures, metrics, reports
from .benchmark.in_memory.evaluation import evaluate, evaluate_frames
from .benchmark.in_memory.filled import Filled
from .benchmark.in_memory.gap_filler import GapFiller
from .benchmark.in_memory.gap_filling import fill
from .benchmark.in_memory.hidden_gaps import Gaps
from .benchmark.in_memory.recording_inputs import FileRecording, read
from .benchmark.in_memory.score_comparison import compare

__version__: str

__all__ = [
    "FileRecording",
    "Filled",
    "GapFiller",
    "Gaps",
    "__version__",
    "baselines",
    "basics",
    "benchmark",
    "compare",
    "datasets",
    "evaluate",
    "evaluate_frames",
    "figures",
    "fill",
    "metrics",
    "read",
    "reports",
]
