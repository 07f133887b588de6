"""Workers of `fill` that are no processes."""

from concurrent.futures import Future

from mocapbench.benchmark.filling.fill_attempt import FillAttempt, attempt_fill
from mocapbench.benchmark.registry import MODELS, find_calibration


class Here:
    """Workers of this process, which begin attempts in the order of a generator if there is one.

    Models that are ``stopped`` exceed every limit, and those that are ``failing`` cannot do it.
    """

    def __init__(self, seed=0, *, rng=None, stopped=(), failing=()):
        self.seed, self.rng, self.stopped, self.failing = seed, rng, {*stopped}, {*failing}
        self.kept, self.submitted, self.waiting = [], [], {}

    def keep(self, problem):
        self.kept.append(problem)
        return len(self.kept) - 1

    def submit(self, model, problem, seconds, method="impute"):
        self.submitted.append((model, problem, seconds, method))
        future = Future()
        self.waiting[future] = model, self.kept[problem], method
        return future

    def collect(self, futures, watch=lambda *_: None):
        order = [*futures]
        if self.rng is not None:
            self.rng.shuffle(order)
        attempts = {}
        for future in order:
            attempts[future] = self.attempt(*self.waiting.pop(future))
            watch(len(attempts), len(order))
        return attempts

    def attempt(self, model, problem, method):
        if model in self.stopped:
            return FillAttempt(None, "was stopped", stopped=True)
        if model in self.failing:
            return FillAttempt(None, "cannot do it")
        return attempt_fill(
            MODELS.get(model),
            problem,
            2**45,
            seed=self.seed,
            method=method,
            calibration=find_calibration(model),
        )
