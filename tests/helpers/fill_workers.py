"""Workers of `fill` that are no processes."""

from concurrent.futures import Future

from mocapbench.benchmark.filling.fill_attempt import FillAttempt, attempt_fill
from mocapbench.benchmark.registry import MODELS, find_calibration


class Here:
    """Workers of this process, which need no time; slow models take longer than any limit."""

    count = 2

    def __init__(self, slow=()):
        self.slow, self.kept, self.limits, self.asked = slow, [], [], []

    def keep(self, problem):
        self.kept.append(problem)
        return len(self.kept) - 1

    def submit(self, model, problem, seconds, method):
        self.limits.append((model, seconds))
        self.asked.append(method)
        ended = Future()
        if model in self.slow:
            ended.set_result(FillAttempt(None, "took longer", timed_out=True))
        else:
            given, calibration = self.kept[problem], find_calibration(model)
            made = attempt_fill(MODELS.get(model), given, 2**45, method, calibration)
            ended.set_result(made)
        return ended

    def wait_for_any(self, futures):
        return list(futures)[:1]

    def collect(self, future):
        return future.result()
