"""Models that compute in this process: those that are named, and the user's own.

A model that is named takes as long as it takes, and an interrupt stops it: it needs no worker. To
choose among models, many are tried, some of which may fail or take all memory, so that they run in
processes of their own (`mocapbench.benchmark.filling.Workers`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from concurrent.futures import Future
from functools import partial

from mocapbench.baselines import FrameImputer, Model
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.fill_attempt import FillAttempt, fill_problem
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.registry import MODELS, find_calibration
from mocapbench.benchmark.runs.fitting.solve import build_model

__all__ = ["ThisProcess"]


class ThisProcess:
    """In place of workers, this process: it solves a problem as soon as that is submitted.

    Parameters
    ----------
    own : mapping of str to callable
        What builds the user's own models.
    seed : int
        Of what registered models draw at random.
    """

    def __init__(self, own: Mapping[str, Callable[[], FrameImputer]], seed: int) -> None:
        self._own = own
        self.seed: int = seed

    def keep(self, problem: GapProblem) -> GapProblem:
        """Return the problem, as it need not be handed over."""
        return problem

    def submit(
        self, model: str, problem: GapProblem, seconds: float, method: str = "impute"
    ) -> Future[FillAttempt]:
        """Have a model solve a problem; what it raises is raised here."""
        del seconds
        future: Future[FillAttempt] = Future()
        try:
            future.set_result(fill_problem(partial(self._build, model), problem, method))
        except Exception as error:
            raise UsageError(f"{model} did not fill it: {reason(error)}") from error
        return future

    def collect(
        self,
        futures: Collection[Future[FillAttempt]],
        watch: Callable[[int, int], object] = lambda *_: None,
    ) -> dict[Future[FillAttempt], FillAttempt]:
        """Return how attempts ended, which all have."""
        watch(len(futures), len(futures))
        return {future: future.result() for future in futures}

    def _build(self, name: str) -> Model:
        if name in self._own:
            return self._own[name]()
        return build_model(MODELS.get(name), {}, self.seed, find_calibration(name))
