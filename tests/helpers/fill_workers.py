"""Workers of `fill` that are no processes."""

from concurrent.futures import Future

from mocapbench.benchmark.filling.attempt import Attempt, attempt
from mocapbench.benchmark.registry import MODELS


class Here:
    """Workers of this process, which need no time; slow models take longer than any limit."""

    count = 2

    def __init__(self, slow=()):
        self.slow, self.kept, self.limits, self.asked = slow, [], [], []

    def keep(self, question):
        self.kept.append(question)
        return len(self.kept) - 1

    def submit(self, model, question, seconds, method):
        self.limits.append((model, seconds))
        self.asked.append(method)
        ended = Future()
        if model in self.slow:
            ended.set_result(Attempt(None, "took longer", slow=True))
        else:
            ended.set_result(attempt(MODELS.get(model), self.kept[question], 2**45, method))
        return ended

    def ended(self, futures):
        return list(futures)[:1]

    def result(self, future):
        return future.result()
