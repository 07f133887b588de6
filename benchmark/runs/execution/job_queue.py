"""The jobs that wait: the longest go first, as far as it is known how long they take."""

from __future__ import annotations

import time
from collections import Counter, defaultdict, deque
from collections.abc import Hashable, Iterable, Iterator, Mapping
from functools import partial

from mocapbench.benchmark.runs.execution.durations import Durations
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["JobQueue"]


_Entrant = tuple[str, str]
"""A task, and the label of one of its entrants."""

_Kind = tuple[_Entrant, str, str]
"""Jobs that are expected to take equally long: an entrant, its case, and what is to be done."""

_FIT, _PREDICT, _SCORE = "fit", "predict", "score"

_MANY = 20
"""Jobs of a case beside which one that is tried out of order costs little."""


def _entrant(job: Job | Record) -> _Entrant:
    return job.address.task, job.address.label


def _kind(job: Job | Record, left: str) -> _Kind:
    return _entrant(job), job.address.case, left


def _list_of_entrant(kind: _Kind) -> tuple[Hashable, ...]:
    entrant, _, left = kind
    return kind, (entrant, left)


def _list_alike(kind: _Kind) -> tuple[Hashable, ...]:
    """Return among what jobs to look for alike ones, the most alike first."""
    (_, label), _, left = kind
    return *_list_of_entrant(kind), (label, left), left, ()


class JobQueue:
    """Jobs in an order that keeps all workers busy to the end.

    First goes one job of each entrant and task, and of each case that has many jobs, to learn how
    long they take; then those of the slowest cases. Of jobs that share their predictions only one
    waits at first, since the others can score what it predicts; of those that share a fitted model
    only one, too.

    Parameters
    ----------
    jobs : iterable of Job
    finished : iterable of Record, optional
        Of jobs that ended before, and tell how long others take.
    """

    def __init__(self, jobs: Iterable[Job], finished: Iterable[Record] = ()) -> None:
        self._waiting: dict[_Kind, deque[Job]] = defaultdict(deque)
        self._followers: dict[str, list[Job]] = defaultdict(list)
        self._following: Counter[_Kind] = Counter()
        self._leads: dict[str, Job] = {}
        self._running: dict[str, tuple[_Kind, float]] = {}
        self._durations = Durations()
        # Kept, as thousands of kinds are asked for whenever a job is taken or ends.
        self._expected: dict[_Kind, float] = {}
        self._kinds: dict[_Entrant, dict[_Kind, None]] = defaultdict(dict)
        self.n_jobs: int = 0
        """How many jobs there are to do."""
        for job in jobs:
            self.n_jobs += 1
            shared = [key for key in (job.fit_key, job.training_key) if key in self._leads]
            for key in {job.fit_key, job.training_key} - {"", *shared}:
                self._leads[key] = job
            if shared:
                self._hold(shared[0], job)
            else:
                self._append(job, _FIT)
        self._learn_from(finished)
        self._untried = deque(self._list_untried())

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

    def _learn_from(self, finished: Iterable[Record]) -> None:
        """Learn from records how long jobs take that fit a model."""
        for record in finished:
            if record.status is Status.OK and record.seconds is not None:
                self._durations.learn(_list_alike(_kind(record, _FIT)), record.seconds)
        for entrant in self._kinds:
            self._expect_anew(entrant)

    def _list_untried(self) -> Iterator[_Kind]:
        """Yield what to try first: of each entrant the middle, as first cases are often small."""
        for entrant, kinds in self._kinds.items():
            waiting = [kind for kind in kinds for _ in self._waiting.get(kind, ())]
            if waiting and not self._durations.knows([(entrant, _FIT)]):
                yield waiting[len(waiting) // 2]
        counts = Counter({kind[:2]: len(jobs) for kind, jobs in self._waiting.items()})
        for kind, count in self._following.items():
            counts[kind[:2]] += count
        for kind in self._waiting:
            if counts[kind[:2]] >= _MANY and not self._durations.knows([kind]):
                yield kind

    def _append(self, job: Job, left: str) -> None:
        kind = _kind(job, left)
        self._waiting[kind].append(job)
        self._kinds[_entrant(job)][kind] = None

    def _append_freed(self, job: Job, left: str) -> None:
        """Have a job wait that could not start before; the first of an entrant is tried next."""
        if not any(kind[2] == left for kind in self._kinds[_entrant(job)]):
            self._untried.append(_kind(job, left))
        self._append(job, left)

    def take(self) -> Job | None:
        """Return the job to start next; None if none can start now."""
        if not self._waiting:
            return None
        kind, position = self._pick_untried() or (self._find_slowest(), 0)
        jobs = self._waiting[kind]
        job = jobs[position]
        del jobs[position]
        if not jobs:
            del self._waiting[kind]
        self._running[job.key] = (kind, time.monotonic())
        return job

    def _pick_untried(self) -> tuple[_Kind, int] | None:
        """Return where a job waits of a kind to be tried; None if there is none."""
        while self._untried:
            kind = self._untried.popleft()
            if kind in self._waiting:
                return kind, len(self._waiting[kind]) // 2
        return None

    def _find_slowest(self) -> _Kind:
        so_far = self._time_running()
        slowest = max(self._waiting, key=lambda kind: self._expected.get(kind, 0.0))
        also_running = (kind for kind in so_far if kind in self._waiting)
        return max([slowest, *also_running], key=partial(self._expect_seconds, so_far))

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
        self._expect_anew(_entrant(job))
        for follower in self._free_jobs(job.fit_key):
            self._append_freed(follower, _SCORE)
        if self._leads.get(job.training_key) is job:
            self._release(job.training_key, fitted=not rescored)

    def _release(self, training_key: str, *, fitted: bool) -> None:
        """Let all jobs go that wait for a fitted model, or the next that is to fit it."""
        followers = self._free_jobs(training_key)
        if fitted or not followers:
            for follower in followers:
                self._append_freed(follower, _PREDICT)
            return
        lead, *others = followers
        self._leads[training_key] = lead
        self._append(lead, _FIT)
        for other in others:
            self._hold(training_key, other)

    def _time_running(self) -> dict[_Kind, float]:
        """Return how long the jobs that run have taken so far, the longest of each kind."""
        now, longest = time.monotonic(), dict[_Kind, float]()
        for kind, began in self._running.values():
            longest[kind] = max(now - began, longest.get(kind, 0.0))
        return longest

    def _expect_anew(self, entrant: _Entrant) -> None:
        """Keep how long the jobs of an entrant take, as far as others of it tell."""
        for kind in self._kinds[entrant]:
            if self._durations.knows(_list_of_entrant(kind)):
                self._expected[kind] = self._estimate_seconds(kind)

    def _expect_seconds(self, so_far: Mapping[_Kind, float], kind: _Kind) -> float:
        """Return how long a job takes; no less than those of its kind that run have so far."""
        known = self._expected.get(kind)
        expected = self._estimate_seconds(kind) if known is None else known
        return max(expected, so_far.get(kind, 0.0))

    def _estimate_seconds(self, kind: _Kind) -> float:
        """Return how long a job takes, by those most alike.

        To predict or score alone is expected to take as long as to fit too, until one of its kind
        has: as it then goes soon, that is soon known.
        """
        fit = (*kind[:2], _FIT)
        known = self._durations.knows([kind]) or not self._durations.knows(_list_of_entrant(fit))
        return self._durations.expect_seconds(_list_alike(kind if known else fit))

    def time_left(self, n_workers: int) -> float:
        """Return about how many seconds it takes until all jobs have ended."""
        now, expect = time.monotonic(), partial(self._expect_seconds, self._time_running())
        running = [max(expect(kind) - (now - began), 0.0) for kind, began in self._running.values()]
        counts = Counter({kind: len(jobs) for kind, jobs in self._waiting.items()})
        counts.update(self._following)
        waiting = [(expect(kind), count) for kind, count in counts.items() if count]
        work = sum(running) + sum(seconds * count for seconds, count in waiting)
        longest = max([*running, *(seconds for seconds, _ in waiting)], default=0.0)
        return max(work / n_workers, longest)
