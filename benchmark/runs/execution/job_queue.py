"""The jobs that wait: the longest go first, as far as it is known how long they take."""

from __future__ import annotations

import time
from collections import Counter, defaultdict, deque
from collections.abc import Hashable, Iterable

from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.job import Job

__all__ = ["JobQueue"]


_Kind = tuple[str, str, str]
"""Jobs that are expected to take equally long: their task, their label, and what is to be done."""

_FIT, _PREDICT, _SCORE = "fit", "predict", "score"


def _kind(job: Job, left: str) -> _Kind:
    return job.address.task, job.address.label, left


def _list_alike(kind: _Kind) -> tuple[Hashable, ...]:
    """Return among what jobs to look for alike ones, the most alike first."""
    _, label, left = kind
    return kind, (label, left), left, ()


class JobQueue:
    """Jobs in an order that keeps all workers busy to the end.

    One job of each entrant and task goes first, to learn how long they take; then those of the
    slowest entrants. Of jobs that share their predictions only one waits at first, since the
    others can score what it predicts; of those that share a fitted model only one, too.

    Parameters
    ----------
    jobs : iterable of Job
    """

    def __init__(self, jobs: Iterable[Job]) -> None:
        self._waiting: dict[_Kind, deque[Job]] = defaultdict(deque)
        self._followers: dict[str, list[Job]] = defaultdict(list)
        self._following: Counter[_Kind] = Counter()
        self._leads: dict[str, Job] = {}
        self._running: dict[str, tuple[_Kind, float]] = {}
        self._untried: deque[_Kind] = deque()
        self._durations = Durations()
        for job in jobs:
            shared = [key for key in (job.fit_key, job.training_key) if key in self._leads]
            for key in {job.fit_key, job.training_key} - {"", *shared}:
                self._leads[key] = job
            if shared:
                self._hold(shared[0], job)
            else:
                self._append(job, _FIT)

    def _hold(self, key: str, job: Job) -> None:
        self._followers[key].append(job)
        self._following[self._after(key, job)] += 1

    @staticmethod
    def _after(key: str, job: Job) -> _Kind:
        """Return what is left of a job once what it shares under ``key`` is there."""
        return _kind(job, _SCORE if key == job.fit_key else _PREDICT)

    def _free_jobs(self, key: str) -> list[Job]:
        """Return the jobs that wait for ``key``, which no longer do."""
        followers = self._followers.pop(key, [])
        self._following.subtract(self._after(key, job) for job in followers)
        return followers

    def _append(self, job: Job, left: str) -> None:
        kind = _kind(job, left)
        if kind not in self._waiting:
            self._untried.append(kind)
        self._waiting[kind].append(job)

    def take(self) -> Job | None:
        """Return the job to start next; None if none can start now."""
        is_first, kind = bool(self._untried), self._next_kind()
        if kind is None:
            return None
        job = self._pick_typical(kind) if is_first else self._waiting[kind].popleft()
        self._running[job.key] = (kind, time.monotonic())
        return job

    def _pick_typical(self, kind: _Kind) -> Job:
        """Return a job from the middle of its kind: the first cases of a task are often small."""
        waiting = self._waiting[kind]
        job = waiting[len(waiting) // 2]
        del waiting[len(waiting) // 2]
        return job

    def _next_kind(self) -> _Kind | None:
        if self._untried:
            return self._untried.popleft()
        waiting = [kind for kind, jobs in self._waiting.items() if jobs]
        return max(waiting, key=self._expect_seconds, default=None)

    def finish(self, job: Job, seconds: float, *, rescored: bool = False) -> None:
        """Take note that a job that was taken has ended after so many seconds.

        Parameters
        ----------
        job : Job
        seconds : float
        rescored : bool
            Whether it only scored predictions that were there: then there is no fitted model yet.
        """
        kind, _ = self._running.pop(job.key)
        self._durations.learn(_list_alike(kind), seconds)
        for follower in self._free_jobs(job.fit_key):
            self._append(follower, _SCORE)
        if self._leads.get(job.training_key) is job:
            self._release(job.training_key, fitted=not rescored)

    def _release(self, training_key: str, *, fitted: bool) -> None:
        """Let all jobs go that wait for a fitted model, or the next that is to fit it."""
        followers = self._free_jobs(training_key)
        if fitted or not followers:
            for follower in followers:
                self._append(follower, _PREDICT)
            return
        lead, *others = followers
        self._leads[training_key] = lead
        self._append(lead, _FIT)
        for other in others:
            self._hold(training_key, other)

    def _expect_seconds(self, kind: _Kind) -> float:
        """Return how long a job takes.

        No less than jobs of its kind that run have taken so far; nor longer than to fit its model,
        as far as no other tells how long it takes to predict or score alone.
        """
        now, fit = time.monotonic(), (*kind[:2], _FIT)
        expected = self._durations.expect_seconds(_list_alike(kind))
        if not self._durations.knows([kind]) and self._durations.knows([fit]):
            expected = min(expected, self._durations.expect_seconds([fit]))
        so_far = (now - began for running, began in self._running.values() if running == kind)
        return max(expected, *so_far, 0.0)

    def time_left(self, n_workers: int) -> float:
        """Return about how many seconds it takes until all jobs have ended."""
        now = time.monotonic()
        running = [
            max(self._expect_seconds(kind) - (now - started), 0.0)
            for kind, started in self._running.values()
        ]
        counts = Counter({kind: len(jobs) for kind, jobs in self._waiting.items()})
        counts.update(self._following)
        waiting = [(self._expect_seconds(kind), count) for kind, count in counts.items()]
        work = sum(running) + sum(seconds * count for seconds, count in waiting)
        longest = max([*running, *(seconds for seconds, count in waiting if count)], default=0.0)
        return max(work / n_workers, longest)
