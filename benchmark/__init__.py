"""The harness: tasks and problems, runs, the regression gate, comparisons, the command line.

What a task, a comparison or a gate of your own needs is here: `Task`, `Case`, `Entrant`, `Profile`,
the problems (`ImputeProblem`, `SynthesiseProblem`, `ClusterProblem`, `RecoverProblem`), the figures
of a page (`draw_gap_error` …), and `plan`, `run`, `check` and `compare`. Each is loaded at
first use.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
